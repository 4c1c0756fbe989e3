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

// World space, metres; vertices are not shared between primitives.
struct StaticScene {
  std::vector<Vec3> position;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

// Skins and morph targets are ignored; points and lines are left out. Fails with BAD_FILE, also where no
// triangle is shown; the message names the fault, and the caller adds the name of the file.
StaticScene import_static_scene(const std::filesystem::path& path);

// From memory, without access to any file: buffers must be in the bytes or in data URIs.
StaticScene import_static_scene(std::span<const std::byte> bytes);

}  // namespace nook::bake
