#include <algorithm>
#include <cmath>
#include <map>

#include "core/failure.h"
#include "import/accessor.h"
#include "import/gltf_parts.h"
#include "import/validate.h"

namespace nook::bake {
namespace {

Affine invert(const Affine& a, const std::string& what) {
  if (!is_finite(a) || std::abs(determinant(a)) < 1e-30)
    throw Failure(NOOK_ERROR_BAD_FILE, "%s is not invertible", what.c_str());
  return inverse(a);
}

// The joint's frame in rest space: orthonormal axes, handedness kept right.
Mat3x4 orthonormal_frame(const Affine& a) {
  const std::array<double, 3> origin = transform(a, 0, 0, 0);
  Vec3 x = normalised({float(a.m[0]), float(a.m[4]), float(a.m[8])});
  Vec3 y{float(a.m[1]), float(a.m[5]), float(a.m[9])};
  y = normalised(y - dot(x, y) * x);
  if (dot(x, x) == 0 || dot(y, y) == 0) {
    x = {1, 0, 0};
    y = {0, 1, 0};
  }
  const Vec3 z = cross(x, y);
  Mat3x4 m;
  const float rows[12] = {x.x, y.x, z.x, float(origin[0]), x.y, y.y, z.y, float(origin[1]),
                          x.z, y.z, z.z, float(origin[2])};
  std::copy_n(rows, 12, m.m);
  return m;
}

bool near(const Affine& a, const Affine& b) {
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    difference = std::max(difference, std::abs(a.m[i] - b.m[i]));
    size = std::max(size, std::abs(a.m[i]));
  }
  return difference <= 1e-3 * std::max(size, 1e-12);
}

struct Candidate {
  std::uint32_t node;
  Affine node_from_rest;
};

std::size_t depth(const NodeTree& nodes, std::size_t node) {
  std::size_t d = 0;
  for (std::int32_t p = nodes.nodes[node].parent; p >= 0; p = nodes.nodes[std::size_t(p)].parent) ++d;
  return d;
}

}  // namespace

Skeleton read_skeleton(const tinygltf::Model& model, const NodeTree& nodes, std::vector<std::string>& warnings) {
  const std::vector<Affine> world = default_world_transforms(nodes);
  Skeleton skeleton;
  skeleton.rigid_bone.assign(nodes.size(), -1);
  skeleton.rest_from_skin.resize(model.skins.size());
  skeleton.joint_bone.resize(model.skins.size());

  // Inverse bind matrices of each skin, and the top-most joint of all skins: skins that hold it share its placement.
  std::vector<std::vector<Affine>> inverse_bind(model.skins.size());
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const tinygltf::Skin& skin = model.skins[s];
    const std::string what = "skin " + std::to_string(s);
    if (skin.joints.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "%s has no joints", what.c_str());
    if (skin.joints.size() > max_bone_count)
      throw Failure(NOOK_ERROR_BAD_FILE, "%s has too many joints (got %zu, at most %zu)", what.c_str(),
                    skin.joints.size(), max_bone_count);
    for (int joint : skin.joints)
      if (joint < 0 || std::size_t(joint) >= nodes.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "%s: joint node %d does not exist (file has %zu nodes)", what.c_str(), joint,
                      nodes.size());
    inverse_bind[s].resize(skin.joints.size());
    if (skin.inverseBindMatrices >= 0) {
      const Floats matrices = read_floats(model, skin.inverseBindMatrices, 16, what + " inverse bind matrices");
      if (matrices.count < skin.joints.size())
        throw Failure(NOOK_ERROR_BAD_FILE, "%s: %zu inverse bind matrices for %zu joints", what.c_str(), matrices.count,
                      skin.joints.size());
      for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        double columns[16];
        for (int i = 0; i < 16; ++i) columns[i] = double(matrices.value[16 * j + std::size_t(i)]);
        inverse_bind[s][j] = from_columns(columns);
      }
    }
    std::size_t top = 0;
    for (std::size_t j = 1; j < skin.joints.size(); ++j)
      if (depth(nodes, std::size_t(skin.joints[j])) < depth(nodes, std::size_t(skin.joints[top]))) top = j;
    skeleton.rest_from_skin[s] = world[std::size_t(skin.joints[top])] * inverse_bind[s][top];
  }

  // A node may become several bones where skins disagree about its bind pose.
  std::vector<Candidate> candidates;
  std::map<std::uint32_t, std::vector<std::size_t>> of_node;
  const auto add = [&](std::uint32_t node, const Affine& node_from_rest) {
    for (std::size_t c : of_node[node])
      if (near(candidates[c].node_from_rest, node_from_rest)) return c;
    of_node[node].push_back(candidates.size());
    candidates.push_back({node, node_from_rest});
    return candidates.size() - 1;
  };
  std::vector<std::vector<std::size_t>> joint_candidate(model.skins.size());
  for (std::size_t s = 0; s < model.skins.size(); ++s) {
    const Affine skin_from_rest = invert(skeleton.rest_from_skin[s], "skin " + std::to_string(s) + ": root bind matrix");
    for (std::size_t j = 0; j < model.skins[s].joints.size(); ++j)
      joint_candidate[s].push_back(add(std::uint32_t(model.skins[s].joints[j]), inverse_bind[s][j] * skin_from_rest));
  }
  // Meshes without a skin ride on the node that carries them, if anything above them moves.
  std::vector<char> moves(nodes.size(), 0);
  for (const auto& [node, list] : of_node) moves[node] = 1;
  for (const tinygltf::Animation& animation : model.animations)
    for (const tinygltf::AnimationChannel& channel : animation.channels)
      if (channel.target_node >= 0 && std::size_t(channel.target_node) < nodes.size())
        moves[std::size_t(channel.target_node)] = 1;
  for (std::uint32_t n : nodes.order)
    if (nodes.nodes[n].parent >= 0 && moves[std::size_t(nodes.nodes[n].parent)]) moves[n] = 1;
  std::vector<std::pair<std::uint32_t, std::size_t>> rigid;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (node.mesh < 0 || node.skin >= 0) continue;
    if (!moves[n] && !(model.skins.empty() && !model.animations.empty())) {
      warnings.push_back("node \"" + nodes.nodes[n].name + "\": a mesh that nothing moves is left out");
      continue;
    }
    // Ride on the nearest joint where the node itself is none: then no bone is added.
    std::uint32_t carrier = n;
    while (!of_node.count(carrier) && nodes.nodes[carrier].parent >= 0 &&
           moves[std::size_t(nodes.nodes[carrier].parent)]) {
      bool animated = false;
      for (const tinygltf::Animation& animation : model.animations)
        for (const tinygltf::AnimationChannel& channel : animation.channels)
          animated |= channel.target_node == int(carrier);
      if (animated) break;
      carrier = std::uint32_t(nodes.nodes[carrier].parent);
    }
    rigid.push_back({n, add(carrier, invert(world[carrier], "node \"" + nodes.nodes[carrier].name + "\": transform"))});
  }
  if (candidates.empty()) throw Failure(NOOK_ERROR_BAD_FILE, "no skin and no animated node carries a mesh");
  if (candidates.size() > max_bone_count)
    throw Failure(NOOK_ERROR_BAD_FILE, "too many bones (got %zu, at most %zu)", candidates.size(), max_bone_count);

  // Parents first: in the order of the node tree.
  std::vector<std::size_t> rank(nodes.size());
  for (std::size_t i = 0; i < nodes.order.size(); ++i) rank[nodes.order[i]] = i;
  std::vector<std::size_t> order(candidates.size()), bone_of(candidates.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rank[candidates[a].node] < rank[candidates[b].node];
  });
  std::vector<std::int32_t> first_bone_of_node(nodes.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Candidate& c = candidates[order[i]];
    bone_of[order[i]] = i;
    Bone bone;
    bone.name = nodes.nodes[c.node].name;
    for (std::int32_t p = nodes.nodes[c.node].parent; p >= 0 && bone.parent < 0; p = nodes.nodes[std::size_t(p)].parent)
      bone.parent = first_bone_of_node[std::size_t(p)];
    const Affine rest_from_node = invert(c.node_from_rest, "bone \"" + bone.name + "\": bind matrix");
    bone.frame_rest = orthonormal_frame(rest_from_node);
    if (first_bone_of_node[c.node] < 0) first_bone_of_node[c.node] = std::int32_t(i);
    skeleton.bindings.push_back({c.node, c.node_from_rest, transform(rest_from_node, 0, 0, 0)});
    const Similarity at_default = nearest_similarity(world[c.node] * c.node_from_rest, skeleton.bindings.back().origin_rest);
    if (at_default.deviation > 1e-2)
      warnings.push_back("bone \"" + bone.name + "\": shear or uneven scale is replaced by the nearest rotation");
    skeleton.bones.push_back(std::move(bone));
  }
  for (std::size_t s = 0; s < model.skins.size(); ++s)
    for (std::size_t c : joint_candidate[s]) skeleton.joint_bone[s].push_back(std::uint16_t(bone_of[c]));
  for (const auto& [node, c] : rigid) skeleton.rigid_bone[node] = std::int32_t(bone_of[c]);
  return skeleton;
}

}  // namespace nook::bake
