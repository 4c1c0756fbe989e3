// What stands still in a glTF 2.0 file: every triangle that its default scene shows, where its nodes put it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/vec.h"

namespace nook::bake {

// A diffuse surface, the same from both sides. RGB.
struct Surface {
  Vec3 base_colour{0.8f, 0.8f, 0.8f};  // share of light that it sends back, each in [0, 1]
  Vec3 emission;                       // radiance of its own, 0 or above
};

// World space, metres; vertices are not shared between primitives.
struct StaticScene {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  std::vector<Surface> surface;  // the file's materials, then one for primitives that name none
  std::vector<std::uint32_t> triangle_surface;  // an index of surface for each triangle
  std::uint32_t textured = 0;                   // materials whose colour textures were not read
};

// Skins and morph targets are ignored; points and lines are left out. Of materials the base colour's and the
// emission's factors are read, and KHR_materials_emissive_strength. Fails with BAD_FILE, also where no
// triangle is shown; the message names the fault, and the caller adds the name of the file.
StaticScene import_static_scene(const std::filesystem::path& path);

// From memory, without access to any file: buffers must be in the bytes or in data URIs.
StaticScene import_static_scene(std::span<const std::byte> bytes);

}  // namespace nook::bake
