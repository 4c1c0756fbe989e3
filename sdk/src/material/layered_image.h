// Images with four numbers in each texel, in layers and mipmap levels: one level after another, layers x
// height x width x 4. They are read as a texture of a tile that repeats.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sdk/src/core/half.h"
#include "sdk/src/material/filtering.h"
#include "sdk/src/material/spatial_modes.h"

namespace nook::material {

using Four = std::array<float, 4>;

inline Four four(const std::uint16_t* halves) {
  return {from_half(halves[0]), from_half(halves[1]), from_half(halves[2]), from_half(halves[3])};
}
inline Four four(const std::int8_t* integers) {
  return {float(integers[0]) / 127, float(integers[1]) / 127, float(integers[2]) / 127,
          float(integers[3]) / 127};
}
inline Four four(const float* numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}
inline Four mix(const Four& a, const Four& b, float t) {
  Four out;
  for (int i = 0; i < 4; ++i) out[i] = a[i] + (b[i] - a[i]) * t;
  return out;
}

struct ImageSize {
  std::uint32_t width = 0, height = 0, layers = 0, levels = 0;  // width and height of level 0

  // Where a level begins; that behind the last is the number of numbers.
  std::size_t level_offset(std::uint32_t level) const {
    std::size_t offset = 0;
    for (std::uint32_t l = 0; l < level; ++l)
      offset += std::size_t(level_size(width, l)) * level_size(height, l) * layers * 4;
    return offset;
  }
};

// The place of the layer to read, in tiles, and its level.
struct ImagePlace {
  float u = 0, v = 0, level = 0;
};

template <class Number>
Four bilinear(const ImageSize& size, const Number* numbers, std::uint32_t layer, const ImagePlace& place,
              std::uint32_t level) {
  const std::uint32_t w = level_size(size.width, level), h = level_size(size.height, level);
  const Between x = repeated(place.u, w), y = repeated(place.v, h);
  const Number* const image = numbers + size.level_offset(level) + std::size_t(layer) * w * h * 4;
  const auto texel = [&](std::uint32_t column, std::uint32_t row) {
    return four(image + (std::size_t(row) * w + column) * 4);
  };
  return mix(mix(texel(x.low, y.low), texel(x.high, y.low), x.t),
             mix(texel(x.low, y.high), texel(x.high, y.high), x.t), y.t);
}

template <class Number>
Four trilinear(const ImageSize& size, const Number* numbers, std::uint32_t layer, const ImagePlace& place) {
  const float level = std::clamp(place.level, 0.0f, float(size.levels - 1));
  const auto low = static_cast<std::uint32_t>(level);
  const Four fine = bilinear(size, numbers, layer, place, low);
  if (level == float(low)) return fine;
  return mix(fine, bilinear(size, numbers, layer, place, low + 1), level - float(low));
}

}  // namespace nook::material
