// Encodes 4 x 4 values from -1 to 1 in blocks of eight bytes, in one of OpenGL's two signed formats: RGTC
// (BC4) or one channel of EAC. Texels are numbered row by row.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::material {

inline constexpr std::size_t signed_block_bytes = 8;
inline constexpr int signed_block_steps = 127;  // the ends of an RGTC block are multiples of 1 / 127

// RGTC stores two end values, then a code of three bits for each texel, with the first texel in the lowest
// bits. Code 0 is the upper end and code 1 the lower end. Codes 2 to 7 lie between them in equal steps, from
// the upper to the lower end. (If the first end were below the second one, it would select another mode of
// RGTC, which this library does not write.)
struct RgtcBlock {
  std::int8_t upper = 0, lower = 0;
  std::uint8_t code[16] = {};
};
void write_rgtc(const RgtcBlock& block, std::uint8_t* bytes);
RgtcBlock read_rgtc(const std::uint8_t* bytes);

// Both functions convert between a code and its position between the ends. Position 0 is the upper end, 7 the
// lower end.
constexpr int sevenths_of(std::uint32_t code) {
  return code == 0 ? 0 : code == 1 ? 7 : int(code) - 1;
}
constexpr std::uint8_t code_of(int sevenths) {
  return std::uint8_t(sevenths == 0 ? 0 : sevenths == 7 ? 1 : sevenths + 1);
}

enum class BlockForm : std::uint32_t { none = 0, rgtc = 1, eac = 2 };

// Writes the eight bytes of a block for values in [-1, 1]. All eight levels of an RGTC block are multiples of
// 1 / 127, so that decoders that round values to bytes also return them exactly. Decoders that also round the
// interpolation weights to bytes, such as llvmpipe, return a value that differs by 1 / 127 in some texels.
void encode_block(BlockForm form, const float (&numbers)[16], std::uint8_t* bytes);

// Decodes one texel of a block exactly as OpenGL specifies.
float decode_texel(BlockForm form, const std::uint8_t* bytes, std::uint32_t texel);

}  // namespace nook::material
