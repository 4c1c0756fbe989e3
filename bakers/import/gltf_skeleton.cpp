#include "bakers/import/gltf_skeleton.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "bakers/import/node_tree.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

// Limits the bind poses of a node, because each joint of a skin is compared with all bind poses of its node
// so far.
constexpr std::size_t max_binds_of_node = 1024;

struct Builder {
  const NodeTree& nodes;
  std::vector<Affine> world;  // default pose
  std::vector<std::uint32_t> depth;
  // The frame of each joint in rest space, with its scale. Other nodes get one only when they become bones.
  std::vector<std::optional<Affine>> bind_rest;
  // The results of implied_bind. Empty until all skins were added.
  std::vector<Affine> implied;
  std::vector<std::int32_t> anchor;        // this node or its nearest ancestor with a bone or motion, or -1
  std::vector<std::int32_t> bone_of_node;  // the first bone of a node, -1: none
  std::vector<BoneBinding> bindings;
  std::vector<Affine> rest_from_node;  // per binding
  std::vector<std::vector<std::uint32_t>> bones_of_node;

  explicit Builder(const NodeTree& tree)
      : nodes(tree),
        world(default_world_transforms(tree)),
        depth(tree.size(), 0),
        bind_rest(tree.size()),
        bone_of_node(tree.size(), -1),
        bones_of_node(tree.size()) {
    for (const std::uint32_t i : nodes.order)
      if (nodes.nodes[i].parent >= 0) depth[i] = depth[nodes.nodes[i].parent] + 1;
  }

  // Returns the rest frame of a node that is not a joint itself. The node follows its nearest ancestor with a
  // bind pose, or stays where the default pose puts it.
  Affine implied_bind(std::uint32_t node) const {
    if (!implied.empty()) return implied[node];
    Affine below;
    for (std::int32_t i = static_cast<std::int32_t>(node); i >= 0; i = nodes.nodes[i].parent) {
      if (bind_rest[i]) return *bind_rest[i] * below;
      below = default_local(nodes.nodes[i]) * below;
    }
    return world[node];
  }

  // Walks down the tree only once. Walking up from each mesh node would be slow for deep chains.
  void settle_rigid_nodes(const std::vector<bool>& moves) {
    std::vector<bool> hangs(nodes.size(), false);  // true for nodes below a bind pose
    implied = world;
    anchor.assign(nodes.size(), -1);
    for (const std::uint32_t i : nodes.order) {
      const std::int32_t parent = nodes.nodes[i].parent;
      hangs[i] = bind_rest[i].has_value() || (parent >= 0 && hangs[parent]);
      if (bind_rest[i])
        implied[i] = *bind_rest[i];
      else if (hangs[i])
        implied[i] = implied[parent] * default_local(nodes.nodes[i]);
      if (bone_of_node[i] >= 0 || moves[i])
        anchor[i] = static_cast<std::int32_t>(i);
      else if (parent >= 0)
        anchor[i] = anchor[parent];
    }
  }

  void require_invertible(const Affine& a, const char* what, std::uint32_t node) const {
    // The determinant is compared with the size of the matrix, because a scale of 0.01 alone gives 1e-6.
    double size = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(a.m[4 * i + j]));
    if (!is_finite(a) || !(std::abs(determinant(a)) > 1e-9 * size * size * size))
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "%s of node %u (\"%s\") is singular or not finite; export it with a scale above 0", what,
                    node, nodes.nodes[node].name.c_str());
  }

  // Returns true if both bindings give the same matrix in every pose, with tolerances of 0.1 % and of 0.1 mm
  // at the joint.
  bool same_binding(const Affine& a, std::uint32_t bone) const {
    const BoneBinding& b = bindings[bone];
    const Affine difference = rest_from_node[bone] * a;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (!(std::abs(difference.m[4 * i + j] - (i == j ? 1 : 0)) < 1e-3)) return false;
    const auto moved = transform(difference, b.origin_rest[0], b.origin_rest[1], b.origin_rest[2]);
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(moved[i] - b.origin_rest[i]) < 1e-4)) return false;
    return true;
  }

  std::uint32_t bone_for(std::uint32_t node, const Affine& node_from_rest) {
    for (const std::uint32_t bone : bones_of_node[node])
      if (same_binding(node_from_rest, bone)) return bone;
    if (bones_of_node[node].size() == max_binds_of_node)
      throw Failure(NOOK_ERROR_BAD_FILE,
                    "node %u (\"%s\") is a joint of skins with more than %zu different bind poses; split the "
                    "file",
                    node, nodes.nodes[node].name.c_str(), max_binds_of_node);
    if (bindings.size() == max_bone_count)
      throw Failure(NOOK_ERROR_BAD_FILE, "too many bones (need at most %zu)", max_bone_count);
    const std::uint32_t bone = static_cast<std::uint32_t>(bindings.size());
    const Affine frame = inverse(node_from_rest);
    rest_from_node.push_back(frame);
    bindings.push_back({node, node_from_rest, {frame.m[3], frame.m[7], frame.m[11]}});
    bones_of_node[node].push_back(bone);
    if (bone_of_node[node] < 0) bone_of_node[node] = static_cast<std::int32_t>(bone);
    return bone;
  }
};

std::uint32_t top_depth(const Builder& b, const Skin& skin) {
  std::uint32_t top = b.depth[skin.joint[0]];
  for (const std::uint32_t node : skin.joint) top = std::min(top, b.depth[node]);
  return top;
}

// Returns the transform of a skin's meshes to rest space. Skins of one skeleton must agree about rest space.
// So if an earlier skin has bound one of the joints, that joint decides. Otherwise the top-most joint
// decides.
Affine rest_from_mesh(const Builder& b, const Skin& skin) {
  std::size_t reference = 0;
  bool is_shared = false;
  for (std::size_t j = 0; j < skin.joint.size(); ++j) {
    const bool shared = b.bind_rest[skin.joint[j]].has_value();
    const bool higher = b.depth[skin.joint[j]] < b.depth[skin.joint[reference]];
    if ((shared && !is_shared) || (shared == is_shared && higher)) reference = j;
    is_shared = is_shared || shared;
  }
  const Affine s = b.implied_bind(skin.joint[reference]) * skin.inverse_bind[reference];
  b.require_invertible(s, "default world matrix times inverse bind matrix", skin.joint[reference]);
  return s;
}

void add_skin(Builder& b, const Skin& skin, MeshBinding& out) {
  for (std::size_t j = 0; j < skin.joint.size(); ++j)
    b.require_invertible(skin.inverse_bind[j], "inverse bind matrix", skin.joint[j]);
  out.rest_from_mesh = rest_from_mesh(b, skin);
  const Affine mesh_from_rest = inverse(out.rest_from_mesh);
  for (std::size_t j = 0; j < skin.joint.size(); ++j) {
    const std::uint32_t node = skin.joint[j];
    const Affine node_from_rest = skin.inverse_bind[j] * mesh_from_rest;
    out.bone.push_back(static_cast<std::uint16_t>(b.bone_for(node, node_from_rest)));
    if (!b.bind_rest[node]) b.bind_rest[node] = inverse(node_from_rest);
  }
}

void add_rigid_part(Builder& b, std::uint32_t mesh_node, MeshBinding& out) {
  const std::int32_t anchor = b.anchor[mesh_node];
  if (anchor < 0) return;
  const std::uint32_t node = static_cast<std::uint32_t>(anchor);
  if (b.bone_of_node[node] < 0) {
    const Affine frame = b.implied_bind(node);
    b.require_invertible(frame, "default world matrix", node);
    b.bone_for(node, inverse(frame));
    b.bind_rest[node] = frame;
  }
  out.rest_from_mesh = b.implied_bind(mesh_node);
  out.bone = {static_cast<std::uint16_t>(b.bone_of_node[node])};
}

// Returns, for each bone, the first bone of its nearest ancestor that has a bone, or -1.
std::vector<std::int32_t> parent_bones(const Builder& b) {
  std::vector<std::int32_t> above(b.nodes.size(), -1);
  for (const std::uint32_t i : b.nodes.order) {
    const std::int32_t parent = b.nodes.nodes[i].parent;
    if (parent >= 0) above[i] = b.bone_of_node[parent] >= 0 ? b.bone_of_node[parent] : above[parent];
  }
  std::vector<std::int32_t> parent;
  for (const BoneBinding& binding : b.bindings) parent.push_back(above[binding.node]);
  return parent;
}

// Returns the new order of the bones: as the skins list them, except that ancestors come first.
std::vector<std::uint32_t> parents_first(const Builder& b, const std::vector<std::int32_t>& parent_bone) {
  std::vector<std::uint32_t> order;
  std::vector<bool> is_placed(b.bindings.size(), false);
  std::vector<std::uint32_t> chain;
  for (std::uint32_t i = 0; i < b.bindings.size(); ++i) {
    chain.clear();
    for (std::int32_t bone = static_cast<std::int32_t>(i); bone >= 0 && !is_placed[bone];
         bone = parent_bone[bone])
      chain.push_back(bone);
    for (auto bone = chain.rbegin(); bone != chain.rend(); ++bone) {
      is_placed[*bone] = true;
      order.push_back(*bone);
    }
  }
  return order;
}

Mat3x4 frame_of(const Affine& bind_rest) {
  Similarity frame = nearest_similarity(bind_rest, {0, 0, 0});
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) frame.matrix.m[4 * i + j] /= frame.scale;
  return to_float(frame.matrix);
}

}  // namespace

Skeleton build_skeleton(const NodeTree& nodes, const std::vector<Skin>& skins, const std::vector<bool>& moves,
                        const std::vector<std::uint32_t>& rigid_nodes) {
  Builder b(nodes);
  Skeleton out;
  out.skins.resize(skins.size());
  std::vector<std::size_t> by_depth(skins.size());
  std::iota(by_depth.begin(), by_depth.end(), std::size_t{0});
  std::stable_sort(by_depth.begin(), by_depth.end(), [&](std::size_t a, std::size_t c) {
    return top_depth(b, skins[a]) < top_depth(b, skins[c]);
  });
  for (const std::size_t i : by_depth) add_skin(b, skins[i], out.skins[i]);
  b.settle_rigid_nodes(moves);
  out.rigid_parts.resize(rigid_nodes.size());
  for (std::size_t i = 0; i < rigid_nodes.size(); ++i) add_rigid_part(b, rigid_nodes[i], out.rigid_parts[i]);

  const std::vector<std::int32_t> parent_bone = parent_bones(b);
  const std::vector<std::uint32_t> order = parents_first(b, parent_bone);
  std::vector<std::uint16_t> new_index(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) new_index[order[i]] = static_cast<std::uint16_t>(i);
  std::vector<std::string> names;
  for (const std::uint32_t bone : order) names.push_back(nodes.nodes[b.bindings[bone].node].name);
  names = unique_names(names, "bone");
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::int32_t parent = parent_bone[order[i]];
    out.bones.push_back({names[i], parent < 0 ? -1 : std::int32_t{new_index[parent]},
                         frame_of(inverse(b.bindings[order[i]].node_from_rest))});
    out.bindings.push_back(b.bindings[order[i]]);
  }
  for (auto* list : {&out.skins, &out.rigid_parts})
    for (MeshBinding& binding : *list)
      for (std::uint16_t& bone : binding.bone) bone = new_index[bone];
  return out;
}

}  // namespace nook::bake
