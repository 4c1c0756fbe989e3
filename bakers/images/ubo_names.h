// File names of measured BTFs in the layout of Bonn's 2003 database, which UTIA's database has as well: one
// image for each light and view direction, whose name holds tl, pl, tv, pv (tilt and azimuth of light and
// view, degrees), each followed by a number, such as "00012_tl015_pl060_tv030_pv090.png". UTIA has a folder
// for each view, and lights that are moved where they would stand in the camera.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

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

}  // namespace nook::bake::material
