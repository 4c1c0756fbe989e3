// What a glTF file holds, for a person who chooses what to bake.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"

namespace nook::bake {

// A primitive of a mesh as a node shows it.
struct ContentsMesh {
  std::string node, mesh;
  std::int64_t primitive = -1;  // its number in a bake of the character, of the first instance; -1: not in it
  std::size_t vertices = 0, triangles = 0, instances = 1;
  int skin = -1;
  std::string state;  // "in", or why it is not
};

struct ContentsSkin {
  std::string name;
  std::size_t joints = 0, meshes = 0;  // mesh nodes that are in
};

struct ContentsClip {
  std::string name;
  float duration_s = 0;
};

struct GltfContents {
  std::vector<ContentsMesh> meshes;  // in the order of nodes and primitives
  std::vector<ContentsSkin> skins;
  std::vector<ContentsClip> clips;
  std::vector<std::string> warnings;  // of the import as a character; its fault if it fails
};

// Fails with BAD_FILE where the file cannot be read as glTF, and with INVALID_ARGUMENT as node_states does.
GltfContents list_gltf(const std::filesystem::path& path, const ImportOptions& options = {});

}  // namespace nook::bake
