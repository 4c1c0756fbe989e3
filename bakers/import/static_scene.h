// Imports the static geometry of a glTF 2.0 file: every triangle of its default scene, transformed to world
// space by its nodes.
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

// A diffuse surface with RGB colours. Both sides look the same.
struct Surface {
  Vec3 base_colour{0.8f, 0.8f, 0.8f};                          // reflected share of light, each in [0, 1]
  Vec3 emission;                                               // emitted radiance, 0 to max_emission
  TextureUse base_colour_texture = {}, emission_texture = {};  // they multiply the colours above
  float alpha = 1;                                             // multiplies the alpha of base_colour_texture
  float alpha_cutoff = 0;  // where alpha is lower, the surface has a hole; 0: no holes
};

// Geometry in world space, metres. Primitives share no vertices.
struct StaticScene {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Surface> surface;  // the file's materials, and one for primitives without a material
  std::vector<std::uint32_t> triangle_surface;  // an index into `surface` for each triangle
  std::vector<EncodedImage> image;              // images of the surfaces' textures
  std::vector<std::array<TexturePoint, 2>> uv;  // sets 0 and 1 of each vertex; empty if `image` is empty
  std::vector<std::string> warnings;  // one sentence for each thing that was left out or is uncertain
};

// With `skip`, only the colour factors are used instead of the textures, and alpha masks are solid.
enum class SceneTextures { skip, read };

// Ignores skins, points and lines. Applies morph targets with their default weights. Reads base colours,
// emission with KHR_materials_emissive_strength, alpha masks and, with SceneTextures::read, colour textures.
// Surfaces with blended alpha are solid. Fails with BAD_FILE, also if the scene has no triangle. The message
// says what is wrong, but does not name the file; the caller must add the name.
StaticScene import_static_scene(const std::filesystem::path& path,
                                SceneTextures textures = SceneTextures::skip,
                                const ImportOptions& options = {});

// Imports from memory and opens no files. All buffers and images must be in `bytes` or in data URIs.
StaticScene import_static_scene(std::span<const std::byte> bytes,
                                SceneTextures textures = SceneTextures::skip,
                                const MeshSelection& meshes = {});

}  // namespace nook::bake
