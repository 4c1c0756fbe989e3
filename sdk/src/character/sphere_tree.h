// A tree of a body's spheres. For the body's self-shadow, nodes of the tree replace far spheres.
//
// For the plain sum of the default kernel (gamma 1), a far sphere shades by radius^2 * cos / d^2, like the
// field of a charge. If spheres are close together as seen from a key point, one sphere at their centre with
// the sum of their squared radii has almost the same effect. The error is of second order in the extent of
// the node. Each group of 16 neighbouring key points uses the same nodes.
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
  // Splits the spheres in the rest pose until each part is a single sphere. Each split is in the middle of
  // the longest side of the bounding box. The tree is empty if the model has a single sphere or too many
  // spheres for PosedSphereTree, or if its shadow is not a plain sum of the default kernel.
  explicit SphereTree(const CharacterModel& model, Memory* memory = default_memory());

  bool is_empty() const { return nodes_.size() == 0; }
  // The model's spheres in the order in which PosedSphereTree stores them, after its nodes.
  const AlignedArray<std::uint32_t>& order() const { return order_; }
  const AlignedArray<SphereTreeNode>& nodes() const { return nodes_; }

 private:
  AlignedArray<std::uint32_t> order_;
  AlignedArray<SphereTreeNode> nodes_;
};

// Merges the posed spheres into the nodes of the tree, and sets the reach of each node. For key points beyond
// the reach, using the node changes the shadow by less than a fixed multiple of `error`. This is an estimate,
// not a strict bound. `error` is a difference in AO.
SphereTreeView pose_tree(const SphereTree& tree, const SphereSoa& spheres, float error, PosedSphereTree& out);

}  // namespace nook
