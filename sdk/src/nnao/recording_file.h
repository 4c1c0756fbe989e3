// Recorded frames as .nook files. Version 3 of the kind "FRAM" has the sections
//   HEAD  u32: library version, width, height
//         u8: depth kind, clip, layer, view; f32: sky_depth, normal_scale, normal_bias, normal_matrix 9,
//         projection 16, radius, max_radius_px, intensity, power; u8: radius kind (from version 2 on);
//         f32: min_radius_px, fade_begin, fade_end (from version 3 on)
//   PASS  u32 taps; u8: half_resolution, blur, path; f32 blur_sharpness
//   DPTH  depth, one value for each pixel, as write_exact of exact_packing.h stores them
//   NORM  normals, three values for each pixel, stored like DPTH; only if the frame has normals
//   LAYR  the host's layer, two values for each pixel, stored like DPTH; only if there is one
//   AOCC  AO, one value for each pixel, stored like DPTH; only if the recording has AO
//   NETW  the file of the network; may be empty
//   TEXT  vendor, renderer, driver_version, note: for each, u32 number of bytes, then UTF-8
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sdk/src/core/container.h"
#include "sdk/src/core/memory.h"
#include "sdk/src/nnao/recording.h"

namespace nook::nnao {

inline constexpr ContainerKind recording_kind{four_letters("FRAM"), "recorded frame of the screen-space pass",
                                              1, 3};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if check_recording rejects the recording.
std::vector<std::byte> write_recording(const Recording& recording);

// Safe for untrusted bytes, even if their checksum is correct. For an invalid file, the call throws
// Failure(NOOK_ERROR_BAD_FILE or NOOK_ERROR_FILE_VERSION). It allocates no more memory than the images, the
// network and the texts of the file need. The call does not read the network's contents, because a later
// library may have written them.
Recording read_recording(std::span<const std::byte> bytes, Memory* memory = default_memory());

}  // namespace nook::nnao
