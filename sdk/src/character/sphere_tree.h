// The spheres of a body as a tree, whose nodes stand for far spheres in the body's own shadow.
//
// For the plain sum of the default kernel (gamma 1) a far sphere shades by radius^2 * cos / d^2, the field of
// a charge, so that spheres which are close to each other, seen from a key point, act like one sphere of the
// sum of their squared radii at its centre. What that changes is of second order in the extent of the node.
// 16 key points that are near each other share one choice of nodes.
#pragma once

#include <cstdint>

#include "sdk/src/character/model.h"
#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/memory.h"

namespace nook {

// Which spheres of a model form nodes; it does not depend on the pose.
class SphereTree {
 public:
  // Splits the spheres in the rest pose, in the middle of the longest side of their box, down to single ones.
  // Empty where the shadow is no plain sum of the default kernel, where a pose does not fit into
  // PosedSphereTree, and for a single sphere.
  explicit SphereTree(const CharacterModel& model, Memory* memory = default_memory());

  bool is_empty() const { return nodes_.size() == 0; }
  // The model's spheres in the order of their numbers in PosedSphereTree, which begin after those of nodes.
  const AlignedArray<std::uint32_t>& order() const { return order_; }
  const AlignedArray<SphereTreeNode>& nodes() const { return nodes_; }

 private:
  AlignedArray<std::uint32_t> order_;
  AlignedArray<SphereTreeNode> nodes_;
};

// Merges the spheres of a pose into the nodes of the tree. Under `error`, which is an AO, a node stands for
// its spheres where its own estimate of the change of a shadow is below a share of it.
SphereTreeView pose_tree(const SphereTree& tree, const SphereSoa& spheres, float error, PosedSphereTree& out);

}  // namespace nook
