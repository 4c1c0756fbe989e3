// Reads and writes probes as .nook files, and packs coefficients into fewer bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/probe.h"

namespace nook::probe {

enum class Packing : std::uint8_t { float32 = 0, half = 1, rgb9e5 = 2 };

constexpr std::size_t packed_bytes(Packing packing) {
  return packing == Packing::float32 ? 12 : packing == Packing::half ? 6 : 4;
}

inline constexpr float max_half = 65504.0f;
inline constexpr float max_rgb9e5 = 65408.0f;  // 511 / 512 * 2^16

// Packs a colour in the format GL_RGB9_E5: three mantissas of 9 bits, with red in the lowest bits, and a
// shared exponent of 5 bits. Channels are clamped to [0, max_rgb9e5], and NaN becomes 0. The error of each
// channel is at most 2^-9 times the larger of the largest channel and 2^-15.
std::uint32_t to_rgb9e5(Vec3 rgb);
Vec3 from_rgb9e5(std::uint32_t bits);

// Probes as .nook files. The kind "PROB" has the sections
//   HEAD u8 kind, u8 domain, u8 ambient, u8 order, u8 functions, u8 packing;
//        f32: up 3; u32: counts 3; f32: origin_ws 3, spacing_ws 3
//   LOBE Gaussians only: for each function, axis 3 f32 and sharpness f32
//   COEF coefficients, probe by probe, packed as HEAD says: 3 f32, 3 half floats, or one RGB9E5 word
//   GLOS optional, only for Gaussians: amplitudes for glossy reflection, packed like COEF; older libraries
//        skip it
//   RECP recipe, JSON; may be empty
//   WALL version 2, only if the grid has walls: f32 bias; for each cell (see probe.h), its planes, 4 half
//        floats each, and a byte for each side
// A grid without walls is written as version 1, which older libraries can read.

inline constexpr ContainerKind probe_kind{four_letters("PROB"), "light probe", 1, 2};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_probes rejects the probes, or if the packing cannot
// represent a coefficient.
std::vector<std::byte> write_probes(const Probes& probes, Packing packing);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates no more memory than the coefficients
// and the recipe need.
Probes read_probes(std::span<const std::byte> bytes, Memory* memory = default_memory());
Packing packing_of(std::span<const std::byte> bytes);

}  // namespace nook::probe
