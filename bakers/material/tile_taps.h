// Linear reads of images of a tile that repeats, texel x * height + y as in RawMaterial.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nook::bake::material {

// The four texels around a point and their shares.
struct Taps {
  std::size_t texel[4];
  float share[4];
};

// x and y are in tiles.
inline Taps taps_at(std::uint32_t width, std::uint32_t height, float x, float y) {
  const float across = x * float(width) - 0.5f, along = y * float(height) - 0.5f;
  const float left = std::floor(across), low = std::floor(along);
  const float fx = across - left, fy = along - low;
  const auto wrap = [](float at, std::uint32_t side) {
    const long whole = std::lround(at) % long(side);
    return std::size_t(whole < 0 ? whole + long(side) : whole);
  };
  Taps taps{};
  for (int i = 0; i < 4; ++i) {
    const bool right = i & 1, high = i & 2;
    taps.texel[i] = wrap(left + float(right), width) * height + wrap(low + float(high), height);
    taps.share[i] = (right ? fx : 1 - fx) * (high ? fy : 1 - fy);
  }
  return taps;
}

template <class Value>
Value mean_of(const Taps& taps, const Value* map) {
  Value sum = taps.share[0] * map[taps.texel[0]];
  for (int i = 1; i < 4; ++i) sum = sum + taps.share[i] * map[taps.texel[i]];
  return sum;
}

}  // namespace nook::bake::material
