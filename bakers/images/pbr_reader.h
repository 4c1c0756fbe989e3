// The maps of a physically based material from a folder of images, through OpenImageIO.
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

// File names of the maps of a physically based material, as artists and libraries of materials have them,
// such as "Bricks090_4K_NormalGL.png", "rough_wood_diff_4k.jpg" and "cloth_base_color.tif".

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
  bool green_down = false;  // of a normal map in the convention of Direct3D
};

// A name is split into words at signs, digits and steps from lower to upper case; the last word that stands
// for a map decides, so that "rough_wood_diff" is a base colour. Nothing where no word does, and for maps
// that have no use here: ambient occlusion, opacity, emission and specular maps.
std::optional<PbrName> parse_pbr_name(std::string_view file_name);

// Indices of the names.
struct PbrFiles {
  std::size_t base_colour = 0;
  std::optional<std::size_t> normal, roughness, metalness, height, packed;
  bool roughness_is_gloss = false, green_down = false;
};

// Of normal maps in both conventions that of OpenGL is taken, of roughness and gloss the roughness, and a map
// of its own before a packed one. Throws Failure(NOOK_ERROR_BAD_FILE) that names two files of one map, or
// lists names where there is no base colour.
PbrFiles arrange_pbr_names(std::span<const std::string> file_names);

struct PbrFolder {
  PbrMaps maps;
  std::vector<std::string> file_names;  // of the images that were read
};

// Every image of the folder whose name tells a map; folders below it are not searched. The base
// colour is sRGB in integer images and linear in float images; other maps are numbers. Values of colour,
// roughness and metalness are cut to 0 to 1. Images have any size as long as they are as wide as high; each
// is averaged over the cells of a grid of side x side points (periodic_tile.h): colours, heights, slopes of
// normals, squared GGX widths. Their rows begin at the top of the tile, whose y points up. Throws
// Failure(NOOK_ERROR_BAD_FILE) that names the file: unreadable, not square, more than 2^26 texels, too few
// channels, a texel that is not finite; and where the folder cannot be read or its names are those of no set.
PbrFolder read_pbr_folder(const std::filesystem::path& folder, std::uint32_t side);

// The height map of such a set alone: one image, in units of a height scale, y * side + x.
std::vector<float> read_height_map(const std::filesystem::path& file, std::uint32_t side);

// The heights alone, of as many points as the image has texels.
PbrMaps read_height_image(const std::filesystem::path& file);

}  // namespace nook::bake::material
