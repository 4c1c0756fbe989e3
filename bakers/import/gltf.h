// Imports a rigged character from a glTF 2.0 file (.glb or .gltf): welded mesh, bones, clips.
//
// Rest space is the bind-posed body in metres, at the place where the default transforms of the file's nodes
// put it. For the skin's top-most joint r, rest = world_default(r) * inverse_bind(r) * v. So node transforms
// above the skeleton (a 0.01 scale, a 90 degree turn) are part of rest space, and the default pose need not
// be the bind pose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/clip.h"
#include "bakers/import/import_options.h"
#include "bakers/import/node_tree.h"
#include "bakers/import/skinned_mesh.h"

namespace nook::bake {

// A bone's matrix is world(node) * node_from_rest.
struct BoneBinding {
  std::uint32_t node = 0;
  Affine node_from_rest;
  std::array<double, 3> origin_rest{};  // the joint's origin in rest space
};

// A skin of the file, with the transforms of its meshes to rest space.
struct BoundSkin {
  std::uint32_t file_index = 0;
  Affine rest_from_mesh;
  std::vector<std::uint16_t> bone;  // the bone of each joint, in the order of the skin
};

struct ImportedCharacter {
  SkinnedMesh mesh;
  std::vector<Clip> clips;
  NodeTree nodes;
  std::vector<BoneBinding> bindings;  // one for each bone of the mesh
  std::vector<BoundSkin> skins;       // only skins that a visible mesh uses
  // For each primitive of the mesh, the matrix that transforms its POSITION attribute to rest space.
  std::vector<Affine> rest_from_primitive;
  // The POSITION of each vertex of the file, with the morph targets applied. Empty if the character was made
  // from arrays.
  std::vector<Vec3> mesh_position;
  // For each primitive of the mesh, the node of the file that draws it.
  std::vector<std::uint32_t> node_of_primitive;
  std::vector<std::string> warnings;  // one sentence for each thing that the import left out or repaired
  std::uint64_t source_hash = 0;      // the first 64 bits of the hash of what the import read
};

// Fails with BAD_FILE. The message says what is wrong, but does not name the file; the caller must add the
// name.
ImportedCharacter import_gltf(const std::filesystem::path& path, const ImportOptions& options = {});

// Imports from memory and opens no files. All buffers must be in `bytes` or in data URIs.
ImportedCharacter import_gltf(std::span<const std::byte> bytes, const MeshSelection& meshes = {});

}  // namespace nook::bake
