// A tree of a body's spheres. Its nodes stand for far spheres in the body's own shadow.
//
// For the plain sum of the default kernel (gamma 1), a far sphere shades by radius^2 * cos / d^2, like the
// field of a charge. If spheres are close together as seen from a key point, one sphere at their centre with
// the sum of their squared radii acts like all of them. The error is of second order in the extent of the
// node. 16 key points near each other share one choice of nodes.
#pragma once

#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/memory.h"

namespace nook {

// The nodes of a model's spheres, which do not depend on the pose.
class SphereTree {
 public:
  // Splits the spheres in the rest pose, in the middle of the longest side of their box, down to single ones.
  // The tree is empty for a single sphere, if the shadow is not a plain sum of the default kernel, or if a
  // pose does not fit into PosedSphereTree.
  explicit SphereTree(const CharacterModel& model, Memory* memory = default_memory());

  bool is_empty() const { return nodes_.size() == 0; }
  // The model's spheres in the order of their numbers in PosedSphereTree, which come after the nodes'
  // numbers.
  const AlignedArray<std::uint32_t>& order() const { return order_; }
  const AlignedArray<SphereTreeNode>& nodes() const { return nodes_; }

 private:
  AlignedArray<std::uint32_t> order_;
  AlignedArray<SphereTreeNode> nodes_;
};

// Merges the spheres of a pose into the nodes of the tree. A node stands for its spheres where it is
// estimated to change a shadow by less than a fixed multiple of `error`, which is in AO.
SphereTreeView pose_tree(const SphereTree& tree, const SphereSoa& spheres, float error, PosedSphereTree& out);

}  // namespace nook
