// Decoded colour textures. Look-ups return linear colours.
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
  // `rgba` has 4 bytes for each texel. Rows start at the top. Colours are sRGB and not premultiplied by
  // alpha. `width` and `height` must be at least 1.
  Texture(std::uint32_t width, std::uint32_t height, std::vector<std::uint8_t> rgba);

  // Texels are at the centres of equal cells. The look-up interpolates linear colours bilinearly, or takes
  // the nearest texel.
  TextureColour at(const TextureUse& use, TexturePoint vertex_uv) const;

 private:
  TextureColour texel(std::int64_t column, std::int64_t row, const TextureUse& use) const;

  std::uint32_t width_, height_;
  std::vector<std::uint8_t> rgba_;
  std::array<float, 256> linear_;
};

}  // namespace nook::bake
