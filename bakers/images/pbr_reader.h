// The maps of a physically based material from a folder of images, through OpenImageIO.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/material/pbr_maps.h"

namespace nook::bake::material {

struct PbrFolder {
  PbrMaps maps;
  std::vector<std::string> file_names;  // of the images that were read
};

// Every image of the folder whose name tells a map (pbr_names.h); folders below it are not searched. The base
// colour is sRGB in integer images and linear in float images; other maps are numbers. Values of colour,
// roughness and metalness are cut to 0 to 1. Images have any size as long as they are as wide as high; each
// is averaged over the cells of a grid of side x side points (tile_filter.h): colours, heights, slopes of
// normals, squared GGX widths. Their rows begin at the top of the tile, whose y points up. Throws
// Failure(NOOK_ERROR_BAD_FILE) that names the file: unreadable, not square, more than 2^26 texels, too few
// channels, a texel that is not finite; and where the folder cannot be read or its names are those of no set.
PbrFolder read_pbr_folder(const std::filesystem::path& folder, std::uint32_t side);

// The height map of such a set alone: one image, in units of a height scale, y * side + x.
std::vector<float> read_height_map(const std::filesystem::path& file, std::uint32_t side);

// The heights alone, of as many points as the image has texels.
PbrMaps read_height_image(const std::filesystem::path& file);

}  // namespace nook::bake::material
