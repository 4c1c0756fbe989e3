// Blocks of 4 x 4 numbers of -1 to 1 in eight bytes, in the two forms that textures of OpenGL have with
// signs: RGTC (BC4) and the EAC of one channel. Texels are counted row by row.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::material {

inline constexpr std::size_t signed_block_bytes = 8;
inline constexpr int signed_block_steps = 127;  // an end of RGTC is a multiple of 1 / 127

// RGTC: two ends, then a code of three bits for each texel, the first in the lowest bits. Code 0 is the upper
// end, 1 the lower one, and 2 to 7 lie between them in equal steps, from the upper to the lower one. (A lower
// end above the upper one would be another mode of RGTC, which this library does not write.)
struct RgtcBlock {
  std::int8_t upper = 0, lower = 0;
  std::uint8_t code[16] = {};
};
void write_rgtc(const RgtcBlock& block, std::uint8_t* bytes);
RgtcBlock read_rgtc(const std::uint8_t* bytes);

// Sevenths of the way from the upper end of a block to the lower one, and the code of so many.
constexpr int sevenths_of(std::uint32_t code) {
  return code == 0 ? 0 : code == 1 ? 7 : int(code) - 1;
}
constexpr std::uint8_t code_of(int sevenths) {
  return std::uint8_t(sevenths == 0 ? 0 : sevenths == 7 ? 1 : sevenths + 1);
}

enum class BlockForm : std::uint32_t { none = 0, rgtc = 1, eac = 2 };

// Writes the eight bytes of numbers in [-1, 1]. The levels of RGTC blocks are multiples of 1 / 127, so that
// decoders that round levels to those give the numbers of the specification. Decoders whose weights are
// bytes, too, as that of llvmpipe, are off by 1 / 127 in some texels.
void encode_block(BlockForm form, const float (&numbers)[16], std::uint8_t* bytes);

// Returns a number of a block, as the specifications of OpenGL define it.
float decode_texel(BlockForm form, const std::uint8_t* bytes, std::uint32_t texel);

}  // namespace nook::material
