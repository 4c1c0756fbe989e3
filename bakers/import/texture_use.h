// Colour textures as stored in the file. Describes the encoded images, and how surfaces read them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace nook::bake {

struct EncodedImage {
  std::string name;  // name for messages, such as: image 2 ("wood.png")
  std::vector<std::byte> bytes;
};

struct TexturePoint {
  float u = 0, v = 0;  // u points right, v points down; the image covers [0, 1]^2
};

enum class TextureWrap : std::uint8_t { repeat, mirrored, clamped };

struct TextureUse {
  static constexpr std::uint32_t none = ~0u;
  std::uint32_t image = none;
  std::uint8_t uv_set = 0;  // 0 or 1
  TextureWrap wrap_u = TextureWrap::repeat, wrap_v = TextureWrap::repeat;
  bool nearest = false;  // else bilinear
  // From KHR_texture_transform. The two rows of a matrix that transforms (u, v, 1) of a vertex to image
  // coordinates.
  std::array<float, 6> transform{1, 0, 0, 0, 1, 0};

  bool is_used() const { return image != none; }
};

}  // namespace nook::bake
