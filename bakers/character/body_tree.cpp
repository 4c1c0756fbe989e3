#include "bakers/character/body_tree.h"

namespace nook::bake {
namespace {

std::vector<std::uint32_t> parents_first(std::span<const std::int32_t> parent) {
  std::vector<std::uint32_t> order;
  std::vector<char> placed(parent.size(), 0);
  std::vector<std::size_t> chain;
  for (std::size_t b = 0; b < parent.size(); ++b) {
    for (std::int32_t at = std::int32_t(b); at >= 0 && !placed[std::size_t(at)]; at = parent[std::size_t(at)])
      chain.push_back(std::size_t(at));
    for (; !chain.empty(); chain.pop_back()) {
      placed[chain.back()] = 1;
      order.push_back(std::uint32_t(chain.back()));
    }
  }
  return order;
}

}  // namespace

bool is_below(const BodyTree& tree, std::size_t bone, std::size_t ancestor) {
  for (std::int32_t b = tree.parent[bone]; b >= 0; b = tree.parent[std::size_t(b)])
    if (std::size_t(b) == ancestor) return true;
  return false;
}

BodyTree body_tree(const SkinnedMesh& mesh, std::span<const Joint> joints) {
  BodyTree tree;
  for (const Bone& bone : mesh.bones) tree.parent.push_back(bone.parent);
  for (std::size_t b = 0; b < joints.size(); ++b) {
    const std::int32_t next = joints[b].continuation;
    if (next < 0 || tree.parent[std::size_t(next)] == std::int32_t(b)) continue;
    // A limb that hangs on its own end would be a ring.
    if (!is_below(tree, b, std::size_t(next))) tree.parent[std::size_t(next)] = std::int32_t(b);
  }
  tree.order = parents_first(tree.parent);
  return tree;
}

BodyTree body_tree(const SkinnedMesh& mesh) {
  return body_tree(mesh, joint_roles(mesh));
}

}  // namespace nook::bake
