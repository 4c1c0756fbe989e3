// Reads the maps of a physically based material from a folder of images, through OpenImageIO.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/material/pbr_maps.h"

namespace nook::bake::material {

// Recognises names of the maps of a physically based material, as artists and libraries of materials use
// them. Examples are "Bricks090_4K_NormalGL.png", "rough_wood_diff_4k.jpg" and "cloth_base_color.tif".

enum class PbrMap : unsigned char {
  base_colour,
  normal,     // red to the right, green up
  roughness,  // perceptual
  gloss,      // 1 - roughness
  metalness,
  height,
  packed,  // roughness in green, metalness in blue
};

struct PbrName {
  PbrMap map = PbrMap::base_colour;
  bool green_down = false;  // a normal map in the convention of Direct3D
};

// Splits a name into words at signs, digits and steps from lower to upper case. The last word that stands for
// a map decides, so that "rough_wood_diff" is a base colour. Returns nothing if there is no such word, and
// for maps that we do not use: ambient occlusion, opacity, emission and specular maps.
std::optional<PbrName> parse_pbr_name(std::string_view file_name);

// Indices of the names; none for a missing map.
struct PbrFiles {
  std::size_t base_colour = 0;
  std::optional<std::size_t> normal, roughness, metalness, height, packed;
  bool roughness_is_gloss = false, green_down = false;
};

// Chooses between files of one kind: a normal map of OpenGL before one of Direct3D, roughness before gloss,
// and a separate map before a packed one. Throws Failure(NOOK_ERROR_BAD_FILE) that names two files of one
// map, or lists names if there is no base colour.
PbrFiles arrange_pbr_names(std::span<const std::string> file_names);

struct PbrFolder {
  PbrMaps maps;
  std::vector<std::string> file_names;  // images that were read
};

// Reads every image of the folder whose name tells a map; it does not search folders below. The base colour
// is sRGB in integer images and linear in float images. Other maps are plain numbers. Values of colour,
// roughness and metalness are cut to 0 to 1.
//
// Images may have any size, but must be square. Each is averaged over the cells of a grid of side x side
// points (periodic_tile.h): colours, heights, slopes of normals, squared GGX widths. Image rows begin at the
// top of the tile, whose y points up.
//
// Throws Failure(NOOK_ERROR_BAD_FILE) that names the file if it is unreadable or not square, has more than
// 2^26 texels, too few channels or a texel that is not finite. Throws it also if the folder cannot be read or
// has no names of a set.
PbrFolder read_pbr_folder(const std::filesystem::path& folder, std::uint32_t side);

// Reads only the height map of such a set: one image, in units of a height scale, y * side + x.
std::vector<float> read_height_map(const std::filesystem::path& file, std::uint32_t side);

// Reads only the heights. The result has as many points as the image has texels.
PbrMaps read_height_image(const std::filesystem::path& file);

}  // namespace nook::bake::material
