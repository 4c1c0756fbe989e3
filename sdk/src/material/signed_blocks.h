// Blocks of 4 x 4 numbers from -1 to 1 in eight bytes, in the two signed forms that OpenGL's textures have:
// RGTC (BC4) and one channel of EAC. Texels count row by row.
#pragma once

#include <cstddef>
#include <cstdint>

namespace nook::material {

inline constexpr std::size_t signed_block_bytes = 8;
inline constexpr int signed_block_steps = 127;  // the ends of an RGTC block are multiples of 1 / 127

// RGTC stores two ends, then a code of three bits for each texel, the first in the lowest bits. Code 0 is the
// upper end, 1 the lower end, and 2 to 7 lie between them in equal steps, from the upper to the lower one. (A
// lower end above the upper one selects another mode of RGTC, which this library does not write.)
struct RgtcBlock {
  std::int8_t upper = 0, lower = 0;
  std::uint8_t code[16] = {};
};
void write_rgtc(const RgtcBlock& block, std::uint8_t* bytes);
RgtcBlock read_rgtc(const std::uint8_t* bytes);

// Convert between a code and the sevenths of the way from the upper end of a block to the lower one.
constexpr int sevenths_of(std::uint32_t code) {
  return code == 0 ? 0 : code == 1 ? 7 : int(code) - 1;
}
constexpr std::uint8_t code_of(int sevenths) {
  return std::uint8_t(sevenths == 0 ? 0 : sevenths == 7 ? 1 : sevenths + 1);
}

enum class BlockForm : std::uint32_t { none = 0, rgtc = 1, eac = 2 };

// Writes the eight bytes for numbers in [-1, 1]. The levels of RGTC blocks are multiples of 1 / 127. Decoders
// that round to these multiples then return the specified numbers. Decoders whose weights are also bytes,
// such as llvmpipe's, are off by 1 / 127 in some texels.
void encode_block(BlockForm form, const float (&numbers)[16], std::uint8_t* bytes);

// Returns a number of a block, as the specifications of OpenGL define it.
float decode_texel(BlockForm form, const std::uint8_t* bytes, std::uint32_t texel);

}  // namespace nook::material
