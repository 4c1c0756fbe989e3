// The static geometry of a glTF 2.0 file: every triangle of its default scene, placed by its nodes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"
#include "bakers/import/texture_use.h"
#include "sdk/src/core/vec.h"

namespace nook::bake {

// The largest radiance that a surface may send of its own.
inline constexpr double max_emission = 1e15;

// A diffuse surface, the same from both sides. RGB.
struct Surface {
  Vec3 base_colour{0.8f, 0.8f, 0.8f};  // share of light that it sends back, each in [0, 1]
  Vec3 emission;                       // radiance of its own, 0 to max_emission
  TextureUse base_colour_texture = {}, emission_texture = {};  // they multiply
  float alpha = 1;                                             // multiplies that of base_colour_texture
  float alpha_cutoff = 0;                                      // less alpha is a hole; 0: none
};

// World space, metres; vertices are not shared between primitives.
struct StaticScene {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Surface> surface;  // the file's materials, then one for primitives that name none
  std::vector<std::uint32_t> triangle_surface;  // an index of surface for each triangle
  std::vector<EncodedImage> image;              // of the surfaces' textures
  std::vector<std::array<TexturePoint, 2>> uv;  // sets 0 and 1 of each vertex; empty where image is
  std::vector<std::string> warnings;            // what was left out or is in doubt, one sentence each
};

// skip: colour factors stand for their textures, and alpha masks are solid.
enum class SceneTextures { skip, read };

// Skins are ignored, and morph targets have their default weights; points and lines are left out. Of
// materials the base colour, the emission with KHR_materials_emissive_strength, alpha masks and, with
// SceneTextures::read, colour textures are read; blended alpha is solid. Fails with BAD_FILE, also if the
// scene has no triangle; the message names the fault, and the caller adds the name of the file.
StaticScene import_static_scene(const std::filesystem::path& path,
                                SceneTextures textures = SceneTextures::skip,
                                const ImportOptions& options = {});

// From memory, without access to any file: buffers and images must be in the bytes or in data URIs.
StaticScene import_static_scene(std::span<const std::byte> bytes,
                                SceneTextures textures = SceneTextures::skip,
                                const MeshSelection& meshes = {});

}  // namespace nook::bake
