// Builds bones from the skins and rigid parts of a file. Also computes the matrices that transform its meshes
// to rest space.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bakers/import/gltf.h"
#include "bakers/import/node_tree.h"

namespace nook::bake {

struct Skin {
  std::vector<std::uint32_t> joint;  // nodes
  std::vector<Affine> inverse_bind;  // one for each joint, invertible
};

// The transform of one mesh node to rest space, and the bones of its joints. A rigid part has one joint, with
// index 0.
struct MeshBinding {
  Affine rest_from_mesh;
  std::vector<std::uint16_t> bone;  // one for each joint of the skin
};

struct Skeleton {
  std::vector<Bone> bones;
  std::vector<BoneBinding> bindings;
  std::vector<MeshBinding> skins;        // one for each skin given
  std::vector<MeshBinding> rigid_parts;  // one for each rigid node given; a part without a bone is static
};

// `moves` is true for nodes that a clip animates. `rigid_nodes` are mesh nodes without a skin. The time is
// O((nodes + joints) * bind poses per joint + skins * tree depth). There are at most 1,024 bind poses per
// joint, and the tree depth is at most 4,096.
Skeleton build_skeleton(const NodeTree& nodes, const std::vector<Skin>& skins, const std::vector<bool>& moves,
                        const std::vector<std::uint32_t>& rigid_nodes);

}  // namespace nook::bake
