// Computes which two texels a linear filter reads along one axis of a texture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nook::material {

// The indices of two neighbouring texels. t is the position between their centres, from 0 to 1.
struct Between {
  std::uint32_t low, high;
  float t;
};

// Use it for an axis that repeats (GL_REPEAT). `at` is a texture coordinate. The range from 0 to 1 covers the
// texture once.
inline Between repeated(float at, std::uint32_t size) {
  const float place = (at - std::floor(at)) * float(size) - 0.5f, low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low + float(size)) % size;
  return {first, (first + 1) % size, place - low};
}

// Use it for an axis that is clamped to the edge. Beyond the centre of the outermost texel, that texel's
// value is used.
inline Between edge_clamped(float at, std::uint32_t size) {
  const float place = std::clamp(at * float(size) - 0.5f, 0.0f, float(size - 1)), low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low);
  return {first, std::min(first + 1, size - 1), place - low};
}

}  // namespace nook::material
