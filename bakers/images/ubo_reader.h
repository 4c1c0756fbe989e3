// Measured BTFs from a folder of images, through OpenImageIO.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/material/raw_material.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::material {

// File names of measured BTFs in the layout of Bonn's 2003 database, which UTIA's database has as well: one
// image for each light and view direction, whose name holds tl, pl, tv, pv (tilt and azimuth of light and
// view, degrees), each followed by a number, such as "00012_tl015_pl060_tv030_pv090.png". UTIA has a folder
// for each view, and lights that are moved where they would stand in the camera.

struct UboAngles {
  float light_tilt = 0, light_azimuth = 0, view_tilt = 0, view_azimuth = 0;  // degrees
};

// Nothing where one of the four is not there, or twice.
std::optional<UboAngles> parse_ubo_name(std::string_view file_name);

struct UboGrid {
  std::vector<Vec3> lights, views;  // by tilt, then azimuth
  std::vector<std::size_t> image;   // lights x views: index of the name
};

// Sorts names into a full grid. A light of one view alone within 15 degrees of it stands for the light in
// that view's direction, where that pair is missing. Throws Failure(NOOK_ERROR_BAD_FILE) that names the file
// whose name cannot be read, the two files of the same directions, or the first missing pair of directions
// and how many are missing.
UboGrid arrange_ubo_names(std::span<const std::string> file_names);

// The three channels of float images. Channels that are called X, Y and Z are xyz in any case.
enum class FloatColours {
  rgb,  // linear, primaries of sRGB
  xyz,  // CIE 1931 under D65, as UTIA's database has them
};

// Every image below the folder, named as images/ubo_reader.h says. Integer images are taken as sRGB and made
// linear, float images as linear; one channel stands for three, more than three are cut. `texels` above 0
// takes the square of that side from the middle of the images, and only the rows or tiles that hold it are
// taken into memory. There is no VOTF. Progress counts images. Throws Failure(NOOK_ERROR_BAD_FILE) that names
// the file: unreadable, of another size than the first, a texel of the square that is not finite; also where
// the folder holds no images or not all pairs of directions, or more than `most_bytes` of BTF.
RawMaterial read_ubo_folder(const std::filesystem::path& folder, std::uint32_t texels,
                            const Progress& progress = {}, std::size_t most_bytes = std::size_t{6} << 30,
                            FloatColours colours = FloatColours::rgb);

}  // namespace nook::bake::material
