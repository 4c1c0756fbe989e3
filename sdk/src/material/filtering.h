// Where a linear filter reads along one side of a texture.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nook::material {

// Two neighbouring texels along one side, and the position between their centres.
struct Between {
  std::uint32_t low, high;
  float t;
};

// For a side that repeats, with coordinates 0 to 1.
inline Between repeated(float at, std::uint32_t size) {
  const float place = (at - std::floor(at)) * float(size) - 0.5f, low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low + float(size)) % size;
  return {first, (first + 1) % size, place - low};
}

// For a side that ends: beyond the centre of the outermost texel, the value is that texel's.
inline Between edge_clamped(float at, std::uint32_t size) {
  const float place = std::clamp(at * float(size) - 0.5f, 0.0f, float(size - 1)), low = std::floor(place);
  const auto first = static_cast<std::uint32_t>(low);
  return {first, std::min(first + 1, size - 1), place - low};
}

}  // namespace nook::material
