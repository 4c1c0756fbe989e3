// The hierarchy by which a body hangs together, which is not always that of its rig: feet that a rig moves by
// inverse kinematics are children of its root, and belong to the calves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/joint_roles.h"

namespace nook::bake {

struct BodyTree {
  std::vector<std::int32_t> parent;  // of each bone; -1: a root
  std::vector<std::uint32_t> order;  // bones, each behind its parent
};

// The rig's hierarchy, in which a bone that continues a limb (Joint::continuation) hangs on that limb.
BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints);
BodyTree body_tree(const SkinnedMesh& mesh);

// Returns true where a bone hangs below another.
bool is_below(const BodyTree& tree, std::size_t bone, std::size_t ancestor);

}  // namespace nook::bake
