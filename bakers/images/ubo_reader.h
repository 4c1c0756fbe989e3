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

// File names of measured BTFs in the layout of Bonn's 2003 database, which UTIA's database also uses. There
// is one image for each pair of light and view directions. Its name contains tl, pl, tv and pv (tilt and
// azimuth of light and view), each followed by degrees. An example is "00012_tl015_pl060_tv030_pv090.png".
// UTIA has one folder per view. Where the light would be at the camera's position, UTIA uses a light
// direction nearby.

struct UboAngles {
  float light_tilt = 0, light_azimuth = 0, view_tilt = 0, view_azimuth = 0;  // degrees
};

// Returns nothing if one of the four angles is missing or appears twice.
std::optional<UboAngles> parse_ubo_name(std::string_view file_name);

struct UboGrid {
  std::vector<Vec3> lights, views;  // sorted by tilt, then azimuth
  std::vector<std::size_t> image;   // lights x views: index of the file name
};

// Sorts names into a full grid of lights and views. A pair with equal light and view directions may be
// missing. The image of a moved light then replaces it: a light direction that only this view has, at most 15
// degrees away. Throws Failure(NOOK_ERROR_BAD_FILE) if a name cannot be parsed, if two files have the same
// directions, or if pairs are missing. The message names these files, or the first missing pair and the
// number of missing pairs.
UboGrid arrange_ubo_names(std::span<const std::string> file_names);

// What the three channels of float images mean. Channels with the names X, Y and Z are always `xyz`.
enum class FloatColours {
  rgb,  // linear, sRGB primaries
  xyz,  // CIE 1931 under D65, as in UTIA's database
};

// Reads all images with such names in the folder and its subfolders. Integer images are sRGB and are
// converted to linear; float images are linear. An image with one channel uses this channel for all three.
// Channels after the third are ignored. If `texels` is above 0, reads only a square of this side in the
// middle of each image, and keeps only the rows or tiles that contain it in memory. The result has no VOTF.
// Progress counts images.
//
// Throws Failure(NOOK_ERROR_BAD_FILE) if an image is unreadable, differs in size from the first one, or has a
// texel in the square that is not finite. The message names the file. Also throws it if the folder has no
// images, if pairs of directions are missing, or if the BTF would take more than `most_bytes`.
RawMaterial read_ubo_folder(const std::filesystem::path& folder, std::uint32_t texels,
                            const Progress& progress = {}, std::size_t most_bytes = std::size_t{6} << 30,
                            FloatColours colours = FloatColours::rgb);

}  // namespace nook::bake::material
