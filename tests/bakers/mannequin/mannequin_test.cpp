#if __has_include(<catch2/catch_all.hpp>)
#include <catch2/catch_all.hpp>
#else
#include <catch2/catch.hpp>
#endif

#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bakers/mannequin/mannequin.h"

namespace {

const std::vector<unsigned char>& glb_bytes() {
  static const std::vector<unsigned char> bytes = nook::mannequin::make_mannequin_glb();
  return bytes;
}

const tinygltf::Model& model() {
  static const tinygltf::Model loaded = [] {
    tinygltf::Model result;
    tinygltf::TinyGLTF loader;
    std::string error, warning;
    const auto size = static_cast<unsigned int>(glb_bytes().size());
    const bool is_loaded = loader.LoadBinaryFromMemory(&result, &error, &warning, glb_bytes().data(), size);
    INFO(error << warning);
    REQUIRE(is_loaded);
    REQUIRE(warning.empty());
    return result;
  }();
  return loaded;
}

/// The accessor's elements, which the mannequin packs tightly.
template <typename Element>
std::vector<Element> read(int accessor_index) {
  const tinygltf::Accessor& accessor = model().accessors.at(static_cast<std::size_t>(accessor_index));
  const tinygltf::BufferView& view = model().bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  REQUIRE(accessor.ByteStride(view) == static_cast<int>(sizeof(Element)));
  std::vector<Element> result(accessor.count);
  const unsigned char* from = model().buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset;
  std::memcpy(static_cast<void*>(result.data()), from, accessor.count * sizeof(Element));
  return result;
}

using Joints = std::array<std::uint16_t, 4>;

const tinygltf::Primitive& primitive() {
  return model().meshes.at(0).primitives.at(0);
}

glm::mat4 matrix_of(const tinygltf::Node& node) {
  return glm::mat4(glm::make_mat4(node.matrix.data()));
}
// From the axes and the unit of the mesh to metres with y up: the node above the skeleton.
glm::mat4 metres_from_mesh() {
  return matrix_of(model().nodes.back());
}

std::vector<glm::vec3> mesh_positions() {
  return read<glm::vec3>(primitive().attributes.at("POSITION"));
}
// Places in metres.
std::vector<glm::vec3> positions() {
  auto out = mesh_positions();
  for (glm::vec3& p : out) {
    p = glm::vec3(metres_from_mesh() * glm::vec4(p, 1.0F));
  }
  return out;
}
std::vector<std::uint16_t> indices() {
  return read<std::uint16_t>(primitive().indices);
}
std::vector<Joints> joints() {
  return read<Joints>(primitive().attributes.at("JOINTS_0"));
}
std::vector<glm::vec4> weights() {
  return read<glm::vec4>(primitive().attributes.at("WEIGHTS_0"));
}

const tinygltf::Animation& clip_named(const std::string& name) {
  for (const tinygltf::Animation& animation : model().animations) {
    if (animation.name == name) {
      return animation;
    }
  }
  throw std::runtime_error("no clip is called " + name);
}

float duration_s(const tinygltf::Animation& clip) {
  float last = 0.0F;
  for (const tinygltf::AnimationSampler& sampler : clip.samplers) {
    last = std::max(last, read<float>(sampler.input).back());
  }
  return last;
}

struct LocalPose {
  std::vector<glm::vec3> translations;
  std::vector<glm::quat> rotations;
};

LocalPose bind_pose() {
  LocalPose pose;
  for (const tinygltf::Node& node : model().nodes) {
    glm::dvec3 t(0.0);
    glm::dquat q(1.0, 0.0, 0.0, 0.0);
    if (!node.translation.empty()) {
      t = glm::make_vec3(node.translation.data());
    }
    if (!node.rotation.empty()) {
      q = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    }
    pose.translations.emplace_back(t);
    pose.rotations.emplace_back(q);
  }
  return pose;
}

LocalPose pose_at(const tinygltf::Animation& clip, float time_s) {
  LocalPose pose = bind_pose();
  for (const tinygltf::AnimationChannel& channel : clip.channels) {
    const tinygltf::AnimationSampler& sampler = clip.samplers.at(static_cast<std::size_t>(channel.sampler));
    const std::vector<float> times = read<float>(sampler.input);
    const auto after = static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(std::upper_bound(times.begin(), times.end(), time_s) - times.begin(), 1,
                                   static_cast<std::ptrdiff_t>(times.size()) - 1));
    const float span = times[after] - times[after - 1];
    const float t = std::clamp((time_s - times[after - 1]) / span, 0.0F, 1.0F);
    const auto node = static_cast<std::size_t>(channel.target_node);
    if (channel.target_path == "translation") {
      const auto keys = read<glm::vec3>(sampler.output);
      pose.translations[node] = glm::mix(keys[after - 1], keys[after], t);
    } else {
      const auto keys = read<glm::vec4>(sampler.output);
      const auto quat = [&](std::size_t i) { return glm::quat(keys[i].w, keys[i].x, keys[i].y, keys[i].z); };
      pose.rotations[node] = glm::slerp(quat(after - 1), quat(after), t);
    }
  }
  return pose;
}

std::vector<glm::vec3> skinned(const LocalPose& pose) {
  const std::size_t count = model().nodes.size();
  std::vector<glm::mat4> world(count, glm::mat4(1.0F));
  const auto pose_node = [&](const auto& self, std::size_t i, const glm::mat4& parent) -> void {
    const tinygltf::Node& node = model().nodes[i];
    const glm::mat4 local = node.matrix.empty() ? glm::translate(glm::mat4(1.0F), pose.translations[i]) *
                                                      glm::mat4_cast(pose.rotations[i])
                                                : matrix_of(node);
    world[i] = parent * local;
    for (int child : node.children) {
      self(self, static_cast<std::size_t>(child), world[i]);
    }
  };
  pose_node(pose_node, count - 1, glm::mat4(1.0F));
  const tinygltf::Skin& skin = model().skins.at(0);
  const auto inverse_bind = read<glm::mat4>(skin.inverseBindMatrices);
  std::vector<glm::mat4> bones;
  for (std::size_t i = 0; i < skin.joints.size(); ++i) {
    bones.push_back(world[static_cast<std::size_t>(skin.joints[i])] * inverse_bind[i]);
  }
  const auto rest = mesh_positions();
  const auto bone_indices = joints();
  const auto shares = weights();
  std::vector<glm::vec3> result(rest.size(), glm::vec3(0.0F));
  for (std::size_t v = 0; v < rest.size(); ++v) {
    for (int k = 0; k < 4; ++k) {
      const std::uint16_t bone = bone_indices[v][static_cast<std::size_t>(k)];
      result[v] += shares[v][k] * glm::vec3(bones[bone] * glm::vec4(rest[v], 1.0F));
    }
  }
  return result;
}

const std::vector<std::string> kClips = {"Idle", "Walk", "Run", "Crouch", "Sit", "Wave", "Punch", "Dance"};

}  // namespace

TEST_CASE("the mannequin has the size it promises", "[mannequin]") {
  const auto p = positions();
  CHECK(p.size() >= 5500);
  CHECK(p.size() <= 6500);
  CHECK(model().skins.at(0).joints.size() >= 50);
  float low = 9.0F, high = -9.0F;
  for (const glm::vec3& v : p) {
    low = std::min(low, v.y);
    high = std::max(high, v.y);
  }
  CHECK(std::abs(low) < 0.01F);
  CHECK(std::abs(high - 1.75F) < 0.02F);
}

TEST_CASE("the mannequin's skin is one closed manifold without degenerate triangles", "[mannequin]") {
  const auto p = positions();
  const auto index = indices();
  std::map<std::pair<int, int>, int> half_edges;
  std::vector<std::uint32_t> group(p.size());
  std::iota(group.begin(), group.end(), 0U);
  const auto find = [&](std::uint32_t v) {
    while (group[v] != v) {
      v = group[v] = group[group[v]];
    }
    return v;
  };
  double volume = 0.0;
  double smallest_area = 1.0;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint16_t a = index[i + k], b = index[i + (k + 1) % 3];
      ++half_edges[{a, b}];
      group[find(a)] = find(b);
    }
    const glm::dvec3 a(p[index[i]]), b(p[index[i + 1]]), c(p[index[i + 2]]);
    smallest_area = std::min(smallest_area, 0.5 * glm::length(glm::cross(b - a, c - a)));
    volume += glm::dot(a, glm::cross(b, c)) / 6.0;
  }
  bool is_manifold = true;
  for (const auto& [ends, count] : half_edges) {
    const auto other = half_edges.find({ends.second, ends.first});
    is_manifold = is_manifold && count == 1 && other != half_edges.end();
  }
  CHECK(is_manifold);
  std::set<std::uint32_t> components;
  for (std::uint32_t v = 0; v < p.size(); ++v) {
    components.insert(find(v));
  }
  CHECK(components.size() == 1);
  // A sphere's topology: fingers and legs are nowhere webbed into loops.
  CHECK(static_cast<long>(p.size()) + static_cast<long>(index.size()) / 3 -
            static_cast<long>(half_edges.size()) / 2 ==
        2);
  CHECK(smallest_area > 1e-6);
  // Litres of a person, and positive because triangles face outwards.
  CHECK(volume > 0.05);
  CHECK(volume < 0.10);
}

TEST_CASE("the mannequin's welded positions are distinct", "[mannequin]") {
  std::set<std::array<float, 3>> seen;
  for (const glm::vec3& v : positions()) {
    seen.insert({v.x, v.y, v.z});
  }
  CHECK(seen.size() == positions().size());
}

TEST_CASE("the mannequin's normals are unit and point outwards", "[mannequin]") {
  const auto p = positions();
  auto normals = read<glm::vec3>(primitive().attributes.at("NORMAL"));
  for (glm::vec3& n : normals) {
    n = glm::vec3(metres_from_mesh() * glm::vec4(n, 0.0F)) * 128.0F;
  }
  const auto index = indices();
  float worst = 0.0F;
  for (const glm::vec3& n : normals) {
    worst = std::max(worst, std::abs(glm::length(n) - 1.0F));
  }
  CHECK(worst < 1e-5F);
  bool faces_agree = true;
  for (std::size_t i = 0; i < index.size(); i += 3) {
    const glm::vec3 face = glm::cross(p[index[i + 1]] - p[index[i]], p[index[i + 2]] - p[index[i]]);
    faces_agree = faces_agree &&
                  glm::dot(face, normals[index[i]] + normals[index[i + 1]] + normals[index[i + 2]]) > 0.0F;
  }
  CHECK(faces_agree);
}

TEST_CASE("the mannequin's weights are shares of one", "[mannequin]") {
  const std::size_t bones = model().skins.at(0).joints.size();
  const auto bone_indices = joints();
  const auto shares = weights();
  float worst = 0.0F, lowest = 1.0F;
  bool in_range = true;
  std::set<std::uint16_t> used;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    worst = std::max(worst, std::abs(shares[v].x + shares[v].y + shares[v].z + shares[v].w - 1.0F));
    for (int k = 0; k < 4; ++k) {
      const std::uint16_t bone = bone_indices[v][static_cast<std::size_t>(k)];
      lowest = std::min(lowest, shares[v][k]);
      in_range = in_range && bone < bones;
      if (shares[v][k] > 0.5F) {
        used.insert(bone);
      }
    }
  }
  CHECK(worst < 1e-6F);
  CHECK(lowest >= 0.0F);
  CHECK(in_range);
  // Every bone but the root owns some skin.
  CHECK(used.size() == bones - 1);
}

TEST_CASE("the mannequin's fingers do not pull at each other", "[mannequin]") {
  const auto bone_indices = joints();
  const auto shares = weights();
  const auto finger_of = [](std::uint16_t bone) -> std::string {
    const std::string& name = model().nodes.at(bone).name;
    for (const char* finger : {"thumb", "index", "middle", "ring", "pinky"}) {
      if (name.rfind(finger, 0) == 0) {
        return finger;
      }
    }
    return "";
  };
  float worst = 0.0F;
  for (std::size_t v = 0; v < shares.size(); ++v) {
    const std::string owner = finger_of(bone_indices[v][0]);
    if (owner.empty() || shares[v][0] < 0.6F) {
      continue;
    }
    for (int k = 1; k < 4; ++k) {
      const std::string other = finger_of(bone_indices[v][static_cast<std::size_t>(k)]);
      if (!other.empty() && other != owner) {
        worst = std::max(worst, shares[v][k]);
      }
    }
  }
  CHECK(worst < 0.1F);
}

TEST_CASE("the bind pose reproduces the mesh", "[mannequin]") {
  const auto rest = positions();
  const auto posed = skinned(bind_pose());
  float worst = 0.0F;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    worst = std::max(worst, glm::length(posed[v] - rest[v]));
  }
  CHECK(worst < 1e-5F);
}

TEST_CASE("the mannequin has an armature that turns and scales, without a digit lost", "[mannequin]") {
  const glm::mat4 armature = metres_from_mesh();
  CHECK(armature[0] == glm::vec4(1.0F / 128, 0, 0, 0));
  CHECK(armature[1] == glm::vec4(0, 0, -1.0F / 128, 0));
  CHECK(armature[2] == glm::vec4(0, 1.0F / 128, 0, 0));
  const auto metres = positions(), mesh = mesh_positions();
  bool exact = true;
  for (std::size_t v = 0; v < mesh.size(); ++v) {
    exact = exact && metres[v] * 128.0F == glm::vec3(mesh[v].x, mesh[v].z, -mesh[v].y);
  }
  CHECK(exact);
}

TEST_CASE("the mannequin's clips loop and keep their feet on the ground", "[mannequin]") {
  CHECK(model().animations.size() >= kClips.size());
  for (const std::string& name : kClips) {
    INFO(name);
    const tinygltf::Animation& clip = clip_named(name);
    const float length_s = duration_s(clip);
    CHECK(length_s >= 1.0F);
    CHECK(length_s <= 4.0F);
    const auto first = skinned(pose_at(clip, 0.0F)), last = skinned(pose_at(clip, length_s));
    float seam = 0.0F;
    for (std::size_t v = 0; v < first.size(); ++v) {
      seam = std::max(seam, glm::length(first[v] - last[v]));
    }
    CHECK(seam < 1e-4F);
    // An odd number of samples falls between keys as well as on them.
    constexpr int kSamples = 37;
    float lowest = 1.0F, travel = 0.0F;
    for (int i = 0; i < kSamples; ++i) {
      const auto posed = skinned(pose_at(clip, length_s * static_cast<float>(i) / kSamples));
      for (std::size_t v = 0; v < posed.size(); ++v) {
        lowest = std::min(lowest, posed[v].y);
        travel = std::max(travel, glm::length(posed[v] - first[v]));
      }
    }
    CHECK(lowest > -0.02F);
    CHECK(travel > 0.02F);
  }
}

TEST_CASE("the mannequin's bytes are the same every time", "[mannequin]") {
  CHECK((nook::mannequin::make_mannequin_glb() == glb_bytes()));
}
