// Imports the static geometry of a glTF 2.0 file: every triangle of its default scene, placed by its nodes.
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

// The largest radiance that a surface may emit.
inline constexpr double max_emission = 1e15;

// A diffuse surface, the same from both sides, in RGB.
struct Surface {
  Vec3 base_colour{0.8f, 0.8f, 0.8f};                          // reflected share of light, each in [0, 1]
  Vec3 emission;                                               // emitted radiance, 0 to max_emission
  TextureUse base_colour_texture = {}, emission_texture = {};  // they multiply the colours above
  float alpha = 1;                                             // multiplies the alpha of base_colour_texture
  float alpha_cutoff = 0;                                      // lower alpha is a hole; 0: no holes
};

// Geometry in world space, metres. Primitives share no vertices.
struct StaticScene {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Surface> surface;  // the file's materials, and one for primitives without a material
  std::vector<std::uint32_t> triangle_surface;  // an index of surface for each triangle
  std::vector<EncodedImage> image;              // images of the surfaces' textures
  std::vector<std::array<TexturePoint, 2>> uv;  // sets 0 and 1 of each vertex; empty where image is
  std::vector<std::string> warnings;            // what was left out or is in doubt, one sentence each
};

// skip: textures count as their colour factors, and alpha masks are solid.
enum class SceneTextures { skip, read };

// Ignores skins, points and lines, and gives morph targets their default weights. Reads base colours,
// emission with KHR_materials_emissive_strength, alpha masks and, with SceneTextures::read, colour textures.
// Blended alpha is solid. Fails with BAD_FILE, also if the scene has no triangle; the message names the
// fault, and the caller adds the name of the file.
StaticScene import_static_scene(const std::filesystem::path& path,
                                SceneTextures textures = SceneTextures::skip,
                                const ImportOptions& options = {});

// Imports from memory, without access to any file: buffers and images must be in the bytes or in data URIs.
StaticScene import_static_scene(std::span<const std::byte> bytes,
                                SceneTextures textures = SceneTextures::skip,
                                const MeshSelection& meshes = {});

}  // namespace nook::bake
