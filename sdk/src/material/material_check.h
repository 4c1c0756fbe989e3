// Checks a material. A material that passes can be decoded without further checks.
#pragma once

#include <nook/nook.h>

#include "sdk/src/material/layered_image.h"
#include "sdk/src/material/material.h"

namespace nook::material {

inline constexpr std::uint32_t max_directions = 1024;                 // of lights, and of views
inline constexpr std::uint32_t max_light_modes = 3 * max_directions;  // R_l, three colours for each light
inline constexpr std::uint32_t max_texels = 1024;                     // along u, and along v
inline constexpr std::uint32_t max_mixture = 8;                       // K
inline constexpr std::uint32_t max_row = 512;                         // K R_v, the coefficients of one view
inline constexpr std::uint32_t max_map_side = 512;                    // cells of a resampled view map
// Limits the number of values in the expanded spatial modes of one tensor. The number is C R_l R_v I_x I_y,
// with ranks rounded up to multiples of 4. As half floats, the maximum takes 1 GiB.
inline constexpr std::uint64_t max_expanded = std::uint64_t{1} << 29;
// The maximum size of one tensor's blocks, also 1 GiB. It needs its own limit, because a block of two
// channels takes 16 bytes even if it holds a single texel.
inline constexpr std::uint64_t max_block_bytes = 2 * max_expanded;
// Core entries have at most the magnitude max_core, and all other values max_number. These limits keep the
// decoder's sums finite. Both are powers of two, so that rounding cannot move a value beyond its limit.
inline constexpr float max_core = 0x1p26f;
inline constexpr float max_number = 0x1p14f;
// Limits of a relief: its height above or below the plane z = 0, in tiles; Relief::max_slope (a tilt of 89
// degrees); and the number of steps of the march.
inline constexpr float max_relief_height = 1;
inline constexpr float max_relief_slope = 57.3f;
inline constexpr std::uint32_t max_relief_steps = 64;
// The maximum sizes of a neural material. The numbers of channels and of units must be multiples of 4. This
// applies to the features and to the offset. Up to these sizes, sums of half floats stay finite in all
// layers.
inline constexpr std::uint32_t max_neural_channels = 64;
inline constexpr std::uint32_t max_neural_units = 64;
inline constexpr std::uint32_t max_neural_layers = 4;
// The minimum distance between two unit directions of a set.
inline constexpr float min_distance = 1e-3f;

// These functions throw Failure with `code` for the first fault that they find. The message names the part of
// the material. check_shape checks the sizes that determine the lengths of arrays. Readers call it before
// they read any array.
void check_shape(const TensorShape& shape, std::size_t lights, std::size_t views, const char* name,
                 nook_result code);
// Like check_shape, for a neural material.
void check_neural_shape(const NeuralShape& shape, nook_result code);
void check_material(const Material& material, nook_result code);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the blocks take more than max_block_bytes. If all other
// limits are met, this can happen only for images with very few texels along a side.
void check_block_bytes(const BlockSize& size);

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) for a neural material. `what` is the name of the function's
// feature, for the message. The feature needs light modes, which a neural material does not have.
void refuse_neural(bool is_neural, const char* what);

}  // namespace nook::material
