// Decoded colour textures, looked up in linear light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/import/texture_use.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

struct TextureColour {
  Vec3 rgb{1, 1, 1};  // linear
  float alpha = 1;
};

class Texture {
 public:
  // rgba: 4 bytes a texel, rows from the top; colours in sRGB, not multiplied by alpha. width and height 1 or
  // more.
  Texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba);

  // Texels stand at the centres of equal cells; bilinear between them, in linear light, or the nearest.
  TextureColour at(const TextureUse& use, TexturePoint vertex_uv) const;

 private:
  TextureColour texel(std::int64_t column, std::int64_t row, const TextureUse& use) const;

  std::uint32_t width_, height_;
  std::vector<std::uint8_t> rgba_;
  std::array<float, 256> linear_;
};

}  // namespace nook::bake
