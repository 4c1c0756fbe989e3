// A cube map that a host has rendered.
#pragma once

#include <cstdint>

#include "sdk/src/gl/device.h"

namespace nook::gl {

struct CubeMap {
  GLuint name = 0;
  std::uint32_t face_size_px = 0;  // at the level
  std::uint32_t level = 0;
};

// Binds the cube map to the active unit. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT): it is no cube map, or
// has another size, levels that lack this one, or colours that are neither floats nor normalised. OpenGL ES
// 3.0 and WebGL tell neither sizes nor formats.
void bind_checked(const Device& device, const CubeMap& cube);

}  // namespace nook::gl
