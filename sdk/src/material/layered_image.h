// Samples texture arrays on the CPU. A texel has four values. Mipmap levels are stored one after another,
// each as layers x height x width x 4 values. Reads repeat the image, as GL_REPEAT does.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "sdk/src/core/floats.h"
#include "sdk/src/material/filtering.h"
#include "sdk/src/material/signed_blocks.h"
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

  // Returns the index of the first value of a level. If `level` is the number of levels, returns the total
  // number of values.
  std::size_t level_offset(std::uint32_t level) const {
    std::size_t offset = 0;
    for (std::uint32_t l = 0; l < level; ++l)
      offset += std::size_t(level_size(width, l)) * level_size(height, l) * layers * 4;
    return offset;
  }
};

// The place at which to read a layer: texture coordinates, in tiles, and the mipmap level.
struct ImagePlace {
  float u = 0, v = 0, level = 0;
};

// Filters bilinearly within one level. texel(column, row) returns a texel of the level.
template <class Texel>
Four bilinear(std::uint32_t width, std::uint32_t height, const ImagePlace& place, Texel&& texel) {
  const Between x = repeated(place.u, width), y = repeated(place.v, height);
  return mix(mix(texel(x.low, y.low), texel(x.high, y.low), x.t),
             mix(texel(x.low, y.high), texel(x.high, y.high), x.t), y.t);
}

// Interpolates between two levels. at_level(level) returns the bilinear value of a level.
template <class AtLevel>
Four between_levels(std::uint32_t levels, float wanted, AtLevel&& at_level) {
  const float level = std::clamp(wanted, 0.0f, float(levels - 1));
  const auto low = static_cast<std::uint32_t>(level);
  const Four fine = at_level(low);
  if (level == float(low)) return fine;
  return mix(fine, at_level(low + 1), level - float(low));
}

template <class Number>
Four trilinear(const ImageSize& size, const Number* numbers, std::uint32_t layer, const ImagePlace& place) {
  return between_levels(size.levels, place.level, [&](std::uint32_t level) {
    const std::uint32_t w = level_size(size.width, level), h = level_size(size.height, level);
    const Number* const image = numbers + size.level_offset(level) + std::size_t(layer) * w * h * 4;
    return bilinear(w, h, place, [&](std::uint32_t column, std::uint32_t row) {
      return four(image + (std::size_t(row) * w + column) * 4);
    });
  });
}

// The size of images that are stored in blocks. As in the textures, a layer has two channels, so the four
// values of a texel take two layers. Levels are stored one after another, each as layers x block rows x block
// columns x channels x a block of signed_blocks.h. If a block extends beyond the edge of a level, it repeats
// the last texels of the level.
struct BlockSize {
  std::uint32_t width = 0, height = 0, layers = 0, levels = 0;  // `layers` counts layers of two channels

  static constexpr std::size_t block_bytes = 2 * signed_block_bytes;  // of a block of two channels
  std::uint32_t columns(std::uint32_t level) const { return (level_size(width, level) + 3) / 4; }
  std::uint32_t rows(std::uint32_t level) const { return (level_size(height, level) + 3) / 4; }
  std::size_t layer_bytes(std::uint32_t level) const { return block_bytes * columns(level) * rows(level); }
  std::size_t level_offset(std::uint32_t level) const {
    std::size_t offset = 0;
    for (std::uint32_t l = 0; l < level; ++l) offset += layer_bytes(l) * layers;
    return offset;
  }
};

// `layer` is the first of the two layers that hold the four values.
inline Four trilinear(const BlockSize& size, BlockForm form, const std::uint8_t* blocks, std::uint32_t layer,
                      const ImagePlace& place) {
  return between_levels(size.levels, place.level, [&](std::uint32_t level) {
    const std::size_t columns = size.columns(level), bytes = size.layer_bytes(level);
    const std::uint8_t* const image = blocks + size.level_offset(level) + layer * bytes;
    return bilinear(
        level_size(size.width, level), level_size(size.height, level), place,
        [&](std::uint32_t column, std::uint32_t row) {
          const std::uint8_t* const block = image + BlockSize::block_bytes * (row / 4 * columns + column / 4);
          const std::uint32_t texel = row % 4 * 4 + column % 4;
          return Four{decode_texel(form, block, texel), decode_texel(form, block + signed_block_bytes, texel),
                      decode_texel(form, block + bytes, texel),
                      decode_texel(form, block + bytes + signed_block_bytes, texel)};
        });
  });
}

}  // namespace nook::material
