// The steps of a glTF import between tinygltf's document and Nook's own data.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>
#include <vector>

#include "import/clip.h"
#include "import/gltf.h"
#include "import/node_tree.h"
#include "import/weld.h"

namespace nook::bake {

// All nodes with parents; every index checked.
NodeTree read_nodes(const tinygltf::Model& model);

// Clips with their channels; unnamed ones get "clip_N", equal names a suffix.
std::vector<Clip> read_clips(const tinygltf::Model& model, std::vector<std::string>& warnings);

// Bones of all skins and of rigid parts, and the bone that each joint of each skin became.
struct Skeleton {
  std::vector<Bone> bones;
  std::vector<BoneBinding> bindings;
  std::vector<Affine> rest_from_skin;                // of each skin: mesh space to rest space
  std::vector<std::vector<std::uint16_t>> joint_bone;  // of each skin's joints
  std::vector<std::int32_t> rigid_bone;              // of each node that carries an unskinned mesh; -1: none
};
Skeleton read_skeleton(const tinygltf::Model& model, const NodeTree& nodes, std::vector<std::string>& warnings);

// Triangles of all meshes in node order, then primitive order, in rest space.
FileMesh read_meshes(const tinygltf::Model& model, const NodeTree& nodes, const Skeleton& skeleton,
                     std::vector<std::string>& warnings);

}  // namespace nook::bake
