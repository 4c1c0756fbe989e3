// File names of the maps of a physically based material, as artists and libraries of materials have them,
// such as "Bricks090_4K_NormalGL.png", "rough_wood_diff_4k.jpg" and "cloth_base_color.tif".
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace nook::bake::material {

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

}  // namespace nook::bake::material
