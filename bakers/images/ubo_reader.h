// Measured BTFs from a folder of images, through OpenImageIO.
#pragma once

#include <filesystem>

#include "bakers/material/raw_material.h"
#include "bakers/raytrace/ambient_occlusion.h"

namespace nook::bake::material {

// The three channels of float images. Channels that are called X, Y and Z are xyz in any case.
enum class FloatColours {
  rgb,  // linear, primaries of sRGB
  xyz,  // CIE 1931 under D65, as UTIA's database has them
};

// Every image below the folder, named as images/ubo_names.h says. Integer images are taken as sRGB and made
// linear, float images as linear; one channel stands for three, more than three are cut. `texels` above 0
// takes the square of that side from the middle of the images, and only the rows or tiles that hold it are
// taken into memory. There is no VOTF. Progress counts images. Throws Failure(NOOK_ERROR_BAD_FILE) that names
// the file: unreadable, of another size than the first, a texel of the square that is not finite; also where
// the folder holds no images or not all pairs of directions, or more than `most_bytes` of BTF.
RawMaterial read_ubo_folder(const std::filesystem::path& folder, std::uint32_t texels,
                            const Progress& progress = {}, std::size_t most_bytes = std::size_t{6} << 30,
                            FloatColours colours = FloatColours::rgb);

}  // namespace nook::bake::material
