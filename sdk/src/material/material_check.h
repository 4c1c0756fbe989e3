// The check of a material. A material that passes can be decoded without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/material.h"

namespace nook::material {

inline constexpr std::uint32_t max_directions = 1024;                 // of lights, and of views
inline constexpr std::uint32_t max_light_modes = 3 * max_directions;  // R_l, of three colours of lights
inline constexpr std::uint32_t max_texels = 1024;                     // along u, and along v
inline constexpr std::uint32_t max_mixture = 8;                       // K
inline constexpr std::uint32_t max_row = 512;                         // K R_v, the coefficients of one view
inline constexpr std::uint32_t max_map_side = 512;                    // cells of a resampled view map
// The maximum of C R_l R_v I_x I_y, the numbers of one tensor's expanded spatial modes with ranks rounded up
// to multiples of 4: 1 GiB of half floats.
inline constexpr std::uint64_t max_expanded = std::uint64_t{1} << 29;
// The maximum of the bytes of one tensor's blocks, the same 1 GiB: a block of two numbers has 16 bytes even
// for a single texel.
inline constexpr std::uint64_t max_block_bytes = 2 * max_expanded;
// The maximum of core entries and of all other numbers, so that no sum of the decoder overflows. Both are
// powers of two, so that no number at the limit is rounded beyond it.
inline constexpr float max_core = 0x1p26f;
inline constexpr float max_number = 0x1p14f;
// The maximum height of a relief over or under the plane z = 0, tiles; of the slope of its views, 89 degrees;
// and of the steps of its march.
inline constexpr float max_relief_height = 1;
inline constexpr float max_relief_slope = 57.3f;
inline constexpr std::uint32_t max_relief_steps = 64;
// Sizes of a neural material: channels and units, of features and of the offset, are multiples of 4. So its
// sums of half floats are finite in all layers.
inline constexpr std::uint32_t max_neural_channels = 64;
inline constexpr std::uint32_t max_neural_units = 64;
inline constexpr std::uint32_t max_neural_layers = 4;
// The minimum distance of two directions of a set.
inline constexpr float min_distance = 1e-3f;

// Throw Failure with `code` and the first fault; the message names the part of the material. check_shape runs
// before any number is read and checks the sizes that determine how many numbers there are.
void check_shape(const TensorShape& shape, std::size_t lights, std::size_t views, const char* name,
                 nook_result code);
// Does the same for a neural material.
void check_neural_shape(const NeuralShape& shape, nook_result code);
void check_material(const Material& material, nook_result code);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for blocks of more than max_block_bytes, which only a shape of
// few texels along a side has.
void check_block_bytes(const BlockSize& size);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for a neural material: its radiance is no sum of light modes,
// which `what` needs.
void refuse_neural(bool is_neural, const char* what);

}  // namespace nook::material
