// Stores a grid of diffuse light in a 3D texture of half floats, in the layout that
// shaders/probe/volume/host.glsl reads.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"
#include "sdk/src/probe/probe.h"

namespace nook::gl {

enum class GridForm : std::uint8_t { harmonics = 0, zonal = 1 };
std::uint32_t texels_of(GridForm form);

// The layout of the 3D texture. Layers, each as large as the grid, are stacked along z. The first layers
// contain the coefficients of the probes, four per texel. If there are walls, they are followed by layers
// with the planes of each cell, and layers with the masks of the cell's sides.
struct GridTexelPlan {
  GridForm form = GridForm::harmonics;
  std::uint32_t layers = 0;
  std::array<std::uint32_t, 3> size{};  // of the texture, in texels

  std::uint64_t texels() const { return std::uint64_t(size[0]) * size[1] * size[2]; }
};
GridTexelPlan plan_grid(const probe::Probes& probes, GridForm form);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the basis is ambient dice, or if a coefficient does not fit
// into a half float.
Vector<std::uint16_t> grid_texels(const probe::Probes& probes, const GridTexelPlan& plan, Memory* memory);

std::array<float, 16> grid_frame(const probe::Probes& probes, const GridTexelPlan& plan);

class GridVolume {
 public:
  // Changes GL_TEXTURE_3D of unit 0. The constructor and update may throw Failure; the texture then keeps its
  // old texels.
  GridVolume(Device& device, const probe::Probes& probes, GridForm form);
  void update(const probe::Probes& probes);

  // Replaces the coefficients of one probe by data from a GPU buffer. The buffer contains as many texels of
  // four floats as the form has. The call does not wait for the GPU. Changes GL_TEXTURE_3D of unit 0,
  // GL_ARRAY_BUFFER and GL_PIXEL_UNPACK_BUFFER.
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
