// A grid of diffuse light in a 3D texture, and the GLSL that reads it.
#pragma once

#include <array>
#include <string>

#include "sdk/src/gl/object.h"
#include "sdk/src/gl/probe/grid_texels.h"

namespace nook::gl {

class GridVolume {
 public:
  // Binds GL_TEXTURE_3D of unit 0. Both functions throw Failure; the texture keeps its old texels then.
  GridVolume(Device& device, const probe::Probes& probes, GridForm form);
  void update(const probe::Probes& probes);

  // Replaces the numbers of one probe by a buffer's, as many texels of four floats as the form has; nothing
  // waits. Binds GL_TEXTURE_3D of unit 0, GL_ARRAY_BUFFER and GL_PIXEL_UNPACK_BUFFER.
  void copy_probe(std::size_t index, GLuint buffer, std::uint64_t offset_bytes) const;

  GridForm form() const { return form_; }
  const probe::Grid& grid() const { return grid_; }
  GLuint name() const { return texture_.name(); }
  std::uint64_t bytes() const { return bytes_; }
  const String& source() const { return source_; }
  const std::array<float, 16>& frame() const { return frame_; }
  bool walls() const { return walls_; }

 private:
  Device& device_;
  const GridForm form_;
  Object texture_;
  std::uint64_t bytes_ = 0;
  String source_;
  std::array<float, 16> frame_{};
  bool walls_ = false;
  probe::Grid grid_;
};

}  // namespace nook::gl
