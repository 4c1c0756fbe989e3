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

// Recognises the maps of a physically based material by the file names that artists and material libraries
// use. Examples are "Bricks090_4K_NormalGL.png", "rough_wood_diff_4k.jpg" and "cloth_base_color.tif".

enum class PbrMap : unsigned char {
  base_colour,
  normal,     // red points right, green points up
  roughness,  // perceptual
  gloss,      // 1 - roughness
  metalness,
  height,
  packed,  // roughness in green, metalness in blue
};

struct PbrName {
  PbrMap map = PbrMap::base_colour;
  bool green_down = false;  // a normal map in the Direct3D convention
};

// Splits a name into words at punctuation, at digits, and where an upper-case letter follows a lower-case
// one. If several words name a map, the last one counts, so "rough_wood_diff" is a base colour. Returns
// nothing if no word names a map, or if we do not use the map: ambient occlusion, opacity, emission or
// specular.
std::optional<PbrName> parse_pbr_name(std::string_view file_name);

// For each map, the index of its file name in the list, or nothing if the map is missing.
struct PbrFiles {
  std::size_t base_colour = 0;
  std::optional<std::size_t> normal, roughness, metalness, height, packed;
  bool roughness_is_gloss = false, green_down = false;
};

// Chooses the file for each map. Prefers an OpenGL normal map to a Direct3D one, roughness to gloss, and a
// separate map to a packed one. Throws Failure(NOOK_ERROR_BAD_FILE) if two files are for the same map (the
// message names both), or if there is no base colour (the message lists the names).
PbrFiles arrange_pbr_names(std::span<const std::string> file_names);

struct PbrFolder {
  PbrMaps maps;
  std::vector<std::string> file_names;  // names of the images that were read
};

// Reads every image of the folder whose name is recognised as a map. Does not search subfolders. The base
// colour is sRGB in integer images, and linear in float images. Other maps are always linear. Colour,
// roughness and metalness are clamped to 0 to 1.
//
// Images may have any size, but must be square. They are resampled to a grid of side x side points: the
// texels within each cell of the grid are averaged (periodic_tile.h). We average colours, heights, slopes of
// normals, and squared GGX widths. The first image row is the top of the tile. In the tile, y points up.
//
// Throws Failure(NOOK_ERROR_BAD_FILE) if an image is unreadable or not square, has more than 2^26 texels, has
// too few channels, or has a texel that is not finite. The message names the file. Also throws it if the
// folder cannot be read, or if its file names do not form a set of maps.
PbrFolder read_pbr_folder(const std::filesystem::path& folder, std::uint32_t side);

// Reads a single height map. Heights are relative to a height scale. The index of a point is y * side + x.
std::vector<float> read_height_map(const std::filesystem::path& file, std::uint32_t side);

// Reads a single height map at its own resolution. All other maps of the result are empty.
PbrMaps read_height_image(const std::filesystem::path& file);

}  // namespace nook::bake::material
