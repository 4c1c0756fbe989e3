// A coordinate texture in OpenGL, and the GLSL that reads it.
#pragma once

#include "sdk/src/core/containers.h"
#include "sdk/src/gl/object.h"
#include "sdk/src/synthesis/coordinates.h"

namespace nook::gl {

class CoordinateTexture {
 public:
  // Changes the state of the user `materials` in touched_state.h; the caller holds a StateGuard. Throws
  // Failure.
  CoordinateTexture(Device& device, const synthesis::Coordinates& coordinates);

  GLuint name() const { return texture_.name(); }
  std::uint64_t bytes() const { return bytes_; }
  const String& source() const { return source_; }

 private:
  Object texture_;
  String source_;
  std::uint64_t bytes_ = 0;
};

}  // namespace nook::gl
