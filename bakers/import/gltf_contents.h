// Lists the meshes, skins and clips of a glTF file, so that a user can choose meshes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/import/import_options.h"

namespace nook::bake {

// A primitive of a mesh, as shown by one node.
struct ContentsMesh {
  std::string node, mesh;
  std::int64_t primitive =
      -1;  // index of the primitive in a bake of the character (first instance); -1: not baked
  std::size_t vertices = 0, triangles = 0, instances = 1;
  int skin = -1;
  std::string state = {};  // "in", or the reason why it is left out
};

struct ContentsSkin {
  std::string name;
  std::size_t joints = 0, meshes = 0;  // `meshes` counts the mesh nodes with state "in"
};

struct ContentsClip {
  std::string name;
  float duration_s = 0;
};

struct GltfContents {
  std::vector<ContentsMesh> meshes;  // in the order of nodes and primitives
  std::vector<ContentsSkin> skins;
  std::vector<ContentsClip> clips;
  std::vector<std::string> warnings;  // warnings of the import as a character, or its error
};

// Fails with BAD_FILE if the file cannot be read as glTF. Fails with INVALID_ARGUMENT in the same cases as
// node_states.
GltfContents list_gltf(const std::filesystem::path& path, const ImportOptions& options = {});

}  // namespace nook::bake
