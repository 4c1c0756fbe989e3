// Reads measured BTFs from a folder of images, through OpenImageIO.
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

// File names of measured BTFs in the layout of Bonn's 2003 database, which UTIA's database uses as well.
// There is one image for each light and view direction. Its name holds tl, pl, tv, pv (tilt and azimuth of
// light and view, degrees), each followed by a number, such as "00012_tl015_pl060_tv030_pv090.png". UTIA has
// a folder for each view, and moves lights that would be at the camera's place.

struct UboAngles {
  float light_tilt = 0, light_azimuth = 0, view_tilt = 0, view_azimuth = 0;  // degrees
};

// Returns nothing if one of the four is missing or appears twice.
std::optional<UboAngles> parse_ubo_name(std::string_view file_name);

struct UboGrid {
  std::vector<Vec3> lights, views;  // by tilt, then azimuth
  std::vector<std::size_t> image;   // lights x views: index of the name
};

// Sorts names into a full grid. If a pair is missing, a light of this view alone, within 15 degrees of it,
// stands for the light in the view's direction. Throws Failure(NOOK_ERROR_BAD_FILE) that names the file with
// an unreadable name, the two files with the same directions, or the first missing pair of directions and how
// many are missing.
UboGrid arrange_ubo_names(std::span<const std::string> file_names);

// What the three channels of float images mean. Channels that are called X, Y and Z are always xyz.
enum class FloatColours {
  rgb,  // linear, primaries of sRGB
  xyz,  // CIE 1931 under D65, as UTIA's database has them
};

// Reads every image below the folder whose name is as described above. Integer images are sRGB and are made
// linear; float images are linear. One channel stands for three, and channels after the third are ignored. If
// `texels` is above 0, reads the square of this side in the middle of the images, and keeps in memory only
// the rows or tiles that hold it. The result has no VOTF. Progress counts images.
//
// Throws Failure(NOOK_ERROR_BAD_FILE) that names the file if it is unreadable, differs in size from the
// first, or has a texel in the square that is not finite. Throws it also if the folder has no images, lacks
// pairs of directions, or needs more than `most_bytes` of BTF.
RawMaterial read_ubo_folder(const std::filesystem::path& folder, std::uint32_t texels,
                            const Progress& progress = {}, std::size_t most_bytes = std::size_t{6} << 30,
                            FloatColours colours = FloatColours::rgb);

}  // namespace nook::bake::material
