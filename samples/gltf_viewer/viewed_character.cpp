#include "samples/gltf_viewer/viewed_character.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/gtc/type_ptr.hpp>
#include <regex>
#include <stdexcept>

namespace viewer {
namespace {

float component(const unsigned char* at, int type, bool normalized) {
  const auto as = [at](auto value, float maximum) {
    std::memcpy(&value, at, sizeof value);
    return std::max(float(value) / maximum, -1.0f);
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return normalized ? as(std::int8_t(), 127) : as(std::int8_t(), 1);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return as(std::uint8_t(), normalized ? 255 : 1);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return normalized ? as(std::int16_t(), 32767) : as(std::int16_t(), 1);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return as(std::uint16_t(), normalized ? 65535 : 1);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: {
      std::uint32_t value;
      std::memcpy(&value, at, sizeof value);
      return float(value);
    }
    default: {
      float value;
      std::memcpy(&value, at, sizeof value);
      return value;
    }
  }
}

// Reads the elements of an accessor one after another. Each has `width` numbers.
std::vector<float> read(const tinygltf::Model& model, int index, std::size_t width) {
  const tinygltf::Accessor& accessor = model.accessors.at(std::size_t(index));
  if (accessor.sparse.isSparse || accessor.bufferView < 0)
    throw std::runtime_error("it has sparse accessors; export it without them");
  if (std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(accessor.type))) != width)
    throw std::runtime_error("accessor " + std::to_string(index) + " has the wrong number of components");
  const tinygltf::BufferView& view = model.bufferViews.at(std::size_t(accessor.bufferView));
  const std::vector<unsigned char>& bytes = model.buffers.at(std::size_t(view.buffer)).data;
  const std::size_t stride = std::size_t(accessor.ByteStride(view));
  const std::size_t size =
      std::size_t(tinygltf::GetComponentSizeInBytes(std::uint32_t(accessor.componentType)));
  const std::size_t first = view.byteOffset + accessor.byteOffset;
  if (accessor.count > 0 && first + (accessor.count - 1) * stride + width * size > bytes.size())
    throw std::runtime_error("accessor " + std::to_string(index) + " is outside of its buffer");
  std::vector<float> out(accessor.count * width);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = component(&bytes[first + i / width * stride + i % width * size], accessor.componentType,
                       accessor.normalized);
  return out;
}

int attribute(const tinygltf::Primitive& primitive, const char* name) {
  const auto found = primitive.attributes.find(name);
  return found == primitive.attributes.end() ? -1 : found->second;
}

glm::mat4 local(const Node& node) {
  if (node.has_matrix) return node.matrix;
  glm::mat4 m = glm::mat4_cast(node.rotation);
  for (int axis = 0; axis < 3; ++axis) m[axis] *= node.scale[axis];
  m[3] = glm::vec4(node.translation, 1);
  return m;
}

void read_nodes(const tinygltf::Model& model, CharacterFile& out) {
  out.nodes.resize(model.nodes.size());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& source = model.nodes[n];
    Node& node = out.nodes[n];
    node.name = source.name;
    node.has_matrix = source.matrix.size() == 16;
    if (node.has_matrix) node.matrix = glm::mat4(glm::make_mat4(source.matrix.data()));
    if (source.translation.size() == 3)
      node.translation = glm::vec3(glm::make_vec3(source.translation.data()));
    if (const auto& q = source.rotation; q.size() == 4)
      node.rotation = glm::quat(float(q[3]), float(q[0]), float(q[1]), float(q[2]));
    if (source.scale.size() == 3) node.scale = glm::vec3(glm::make_vec3(source.scale.data()));
    for (const int child : source.children) out.nodes.at(std::size_t(child)).parent = int(n);
  }
  for (std::size_t n = 0; n < out.nodes.size(); ++n)
    if (out.nodes[n].parent < 0) out.parents_first.push_back(int(n));
  for (std::size_t i = 0; i < out.parents_first.size(); ++i)
    for (const int child : model.nodes[std::size_t(out.parents_first[i])].children) {
      if (out.parents_first.size() == out.nodes.size())
        throw std::runtime_error("its nodes do not form a tree");
      out.parents_first.push_back(child);
    }
}

void read_skins(const tinygltf::Model& model, CharacterFile& out) {
  for (const tinygltf::Skin& source : model.skins) {
    Skin skin;
    skin.joints = source.joints;
    skin.inverse_bind.resize(source.joints.size(), glm::mat4(1));
    skin.first_matrix = out.first_node_matrix;
    if (source.inverseBindMatrices >= 0) {
      const std::vector<float> columns = read(model, source.inverseBindMatrices, 16);
      for (std::size_t j = 0; j < skin.joints.size(); ++j)
        skin.inverse_bind[j] = glm::make_mat4(&columns.at(16 * j + 15) - 15);
    }
    out.first_node_matrix += std::uint32_t(skin.joints.size());
    out.skins.push_back(std::move(skin));
  }
}

// Returns the nodes that clips move, the joints, and the children of both. Other parts do not belong to the
// character.
std::vector<bool> moving_nodes(const CharacterFile& file) {
  std::vector<bool> moves(file.nodes.size());
  for (const Skin& skin : file.skins)
    for (const int joint : skin.joints) moves.at(std::size_t(joint)) = true;
  for (const Clip& clip : file.clips)
    for (const Channel& channel : clip.channels) moves.at(std::size_t(channel.node)) = true;
  for (const int n : file.parents_first)
    if (const int parent = file.nodes[std::size_t(n)].parent; parent >= 0 && moves[std::size_t(parent)])
      moves[std::size_t(n)] = true;
  return moves;
}

void compute_normals(CharacterFile& out, std::size_t first_vertex, std::size_t first_index) {
  for (std::size_t i = first_index; i < out.triangles.size(); i += 3) {
    Vertex* const corners[3] = {&out.vertices[out.triangles[i]], &out.vertices[out.triangles[i + 1]],
                                &out.vertices[out.triangles[i + 2]]};
    const glm::vec3 n =
        glm::cross(corners[1]->position - corners[0]->position, corners[2]->position - corners[0]->position);
    for (Vertex* corner : corners) corner->normal += n;
  }
  for (std::size_t v = first_vertex; v < out.vertices.size(); ++v)
    if (glm::length(out.vertices[v].normal) > 0)
      out.vertices[v].normal = glm::normalize(out.vertices[v].normal);
}

// Returns the matrices from the mesh of a node to the node, one for each instance (EXT_mesh_gpu_instancing).
std::vector<glm::mat4> instances(const tinygltf::Model& model, const tinygltf::Node& node) {
  const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
  if (extension == node.extensions.end() || !extension->second.Has("attributes")) return {glm::mat4(1)};
  const tinygltf::Value& attributes = extension->second.Get("attributes");
  const auto values = [&](const char* name, std::size_t components) {
    return attributes.Has(name) ? read(model, attributes.Get(name).GetNumberAsInt(), components)
                                : std::vector<float>();
  };
  const std::vector<float> moves = values("TRANSLATION", 3), turns = values("ROTATION", 4),
                           scales = values("SCALE", 3);
  const std::size_t count = std::max({moves.size() / 3, turns.size() / 4, scales.size() / 3});
  std::vector<glm::mat4> out;
  for (std::size_t i = 0; i < count; ++i) {
    Node place;
    if (!moves.empty()) place.translation = glm::make_vec3(&moves.at(3 * i + 2) - 2);
    if (!turns.empty()) {
      const float* q = &turns.at(4 * i + 3) - 3;
      place.rotation = glm::normalize(glm::quat(q[3], q[0], q[1], q[2]));
    }
    if (!scales.empty()) place.scale = glm::make_vec3(&scales.at(3 * i + 2) - 2);
    out.push_back(local(place));
  }
  return out.empty() ? std::vector{glm::mat4(1)} : out;
}

// What the vertices of a primitive belong to: the node, its skin or -1, and the instance.
struct Shown {
  int node = 0, skin = -1;
  glm::mat4 instance{1};
};

void read_primitive(const tinygltf::Model& model, const tinygltf::Primitive& primitive, const Shown& shown,
                    CharacterFile& out) {
  const int skin = shown.skin;
  const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(shown.instance)));
  if (primitive.mode != TINYGLTF_MODE_TRIANGLES)
    throw std::runtime_error("it has triangle strips or fans; export triangle lists");
  const std::size_t first = out.vertices.size(), first_index = out.triangles.size();
  const std::vector<float> positions = read(model, attribute(primitive, "POSITION"), 3);
  const int normals_at = attribute(primitive, "NORMAL");
  std::vector<float> normals(positions.size()), joints, weights;
  if (normals_at >= 0) normals = read(model, normals_at, 3);
  if (skin >= 0) {
    out.skins.at(std::size_t(skin)).has_mesh = true;
    joints = read(model, attribute(primitive, "JOINTS_0"), 4);
    weights = read(model, attribute(primitive, "WEIGHTS_0"), 4);
  }
  glm::vec3 albedo(0.6f);
  if (primitive.material >= 0) {
    const auto& pbr = model.materials.at(std::size_t(primitive.material)).pbrMetallicRoughness;
    const auto& factor = pbr.baseColorFactor;
    // The viewer reads no images. A material whose colour is in an image has a white factor.
    if (factor.size() >= 3 && factor[0] + factor[1] + factor[2] < 2.9) albedo = glm::make_vec3(factor.data());
  }
  for (std::size_t v = 0; v < positions.size() / 3; ++v) {
    const glm::vec3 normal = turn * glm::make_vec3(&normals.at(3 * v + 2) - 2);
    Vertex vertex{shown.instance * glm::vec4(glm::make_vec3(&positions[3 * v]), 1),
                  glm::length(normal) > 0 ? glm::normalize(normal) : normal,
                  albedo,
                  {},
                  {}};
    vertex.matrices[0] = std::uint16_t(out.first_node_matrix + std::uint32_t(shown.node));
    vertex.weights = {1, 0, 0, 0};
    if (skin >= 0) {
      vertex.weights = glm::make_vec4(&weights.at(4 * v + 3) - 3);
      vertex.weights /= std::max(glm::dot(vertex.weights, glm::vec4(1)), 1e-9f);
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t joint = vertex.weights[int(k)] > 0 ? std::size_t(joints.at(4 * v + k)) : 0;
        if (joint >= out.skins.at(std::size_t(skin)).joints.size())
          throw std::runtime_error("a vertex refers to a joint that does not exist in its skin");
        vertex.matrices[k] = std::uint16_t(out.skins[std::size_t(skin)].first_matrix + joint);
      }
    }
    out.vertices.push_back(vertex);
  }
  if (primitive.indices >= 0) {
    for (const float index : read(model, primitive.indices, 1)) {
      if (std::size_t(index) >= positions.size() / 3) throw std::runtime_error("an index is out of range");
      out.triangles.push_back(std::uint32_t(first) + std::uint32_t(index));
    }
  } else {
    for (std::size_t v = first; v < out.vertices.size(); ++v) out.triangles.push_back(std::uint32_t(v));
  }
  out.triangles.resize(out.triangles.size() - out.triangles.size() % 3);
  if (normals_at < 0) compute_normals(out, first, first_index);
}

bool is_hidden(const tinygltf::Node& node) {
  const auto extension = node.extensions.find("KHR_node_visibility");
  if (extension == node.extensions.end() || !extension->second.Has("visible")) return false;
  const tinygltf::Value& visible = extension->second.Get("visible");
  return visible.IsBool() && !visible.Get<bool>();
}

// Names such as "Body_LOD1" are coarser levels; the model is baked from the finest level.
bool is_lower_level(const std::string& name) {
  static const std::regex level("(^|.*[_.\\- ])LOD0*[1-9][0-9]*", std::regex::icase);
  return std::regex_match(name, level);
}

// Returns the nodes of the scene, except the nodes that a bake leaves out.
std::vector<bool> shown_nodes(const tinygltf::Model& model, const std::vector<std::string>& without,
                              const CharacterFile& out) {
  std::vector<bool> shown(out.nodes.size(), model.scenes.empty()), hidden(out.nodes.size());
  if (!model.scenes.empty())
    for (const int root : model.scenes.at(std::size_t(std::max(model.defaultScene, 0))).nodes)
      shown.at(std::size_t(root)) = true;
  for (const int n : out.parents_first) {
    const tinygltf::Node& node = model.nodes[std::size_t(n)];
    const int parent = out.nodes[std::size_t(n)].parent;
    if (parent >= 0 && shown[std::size_t(parent)]) shown[std::size_t(n)] = true;
    hidden[std::size_t(n)] = (parent >= 0 && hidden[std::size_t(parent)]) || is_hidden(node) ||
                             is_lower_level(node.name) || std::ranges::count(without, node.name) > 0;
  }
  for (std::size_t n = 0; n < shown.size(); ++n) {
    const int mesh = model.nodes[n].mesh;
    const bool is_level = mesh >= 0 && is_lower_level(model.meshes.at(std::size_t(mesh)).name);
    shown[n] = shown[n] && !hidden[n] && !is_level;
  }
  return shown;
}

void read_meshes(const tinygltf::Model& model, const std::vector<std::string>& without, CharacterFile& out) {
  const std::vector<bool> moves = moving_nodes(out), shown = shown_nodes(model, without, out);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const tinygltf::Node& node = model.nodes[n];
    if (node.mesh < 0 || !shown[n] || (node.skin < 0 && !moves[n])) continue;
    for (const glm::mat4& instance : instances(model, node))
      for (const tinygltf::Primitive& primitive : model.meshes.at(std::size_t(node.mesh)).primitives)
        if (primitive.mode != TINYGLTF_MODE_POINTS && primitive.mode > TINYGLTF_MODE_LINE_STRIP)
          read_primitive(model, primitive, {int(n), node.skin, instance}, out);
  }
}

void read_clips(const tinygltf::Model& model, CharacterFile& out) {
  for (const tinygltf::Animation& animation : model.animations) {
    Clip clip;
    clip.name = animation.name;
    for (const tinygltf::AnimationChannel& source : animation.channels) {
      const bool is_rotation = source.target_path == "rotation";
      if (source.target_node < 0 || source.target_path == "weights") continue;
      const tinygltf::AnimationSampler& sampler = animation.samplers.at(std::size_t(source.sampler));
      Channel channel;
      channel.node = source.target_node;
      channel.path = is_rotation                           ? Channel::rotation
                     : source.target_path == "translation" ? Channel::translation
                                                           : Channel::scale;
      channel.has_steps = sampler.interpolation == "STEP";
      channel.times_s = read(model, sampler.input, 1);
      const std::size_t width = is_rotation ? 4 : 3;
      const std::vector<float> values = read(model, sampler.output, width);
      // A cubic spline has tangents on both sides of a value; the viewer draws lines between its values.
      const bool is_spline = sampler.interpolation == "CUBICSPLINE";
      for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
        glm::vec4 value(0);
        for (std::size_t i = 0; i < width; ++i)
          value[int(i)] = values.at((is_spline ? 3 * key + 1 : key) * width + i);
        channel.values.push_back(value);
      }
      if (channel.times_s.empty()) continue;
      clip.duration_s = std::max(clip.duration_s, channel.times_s.back());
      clip.channels.push_back(std::move(channel));
    }
    out.clips.push_back(std::move(clip));
  }
}

glm::quat as_quat(const glm::vec4& v) {
  return glm::quat(v.w, v.x, v.y, v.z);
}

void apply(const Channel& channel, float time_s, std::vector<Node>& nodes) {
  const auto& times = channel.times_s;
  const std::size_t next = std::size_t(std::ranges::upper_bound(times, time_s) - times.begin());
  const std::size_t b = std::min(next, times.size() - 1), a = next == 0 ? 0 : next - 1;
  float share = a == b ? 0 : (time_s - times[a]) / (times[b] - times[a]);
  if (channel.has_steps) share = 0;
  Node& node = nodes.at(std::size_t(channel.node));
  const glm::vec4 value = glm::mix(channel.values[a], channel.values[b], share);
  if (channel.path == Channel::translation) node.translation = glm::vec3(value);
  if (channel.path == Channel::scale) node.scale = glm::vec3(value);
  if (channel.path == Channel::rotation)
    node.rotation = glm::normalize(glm::slerp(as_quat(channel.values[a]), as_quat(channel.values[b]), share));
}

void read_file(const std::filesystem::path& path, const std::vector<std::string>& without,
               CharacterFile& out) {
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error, warning;
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                           int, void*) { return true; },
                        nullptr);
  const bool is_binary = path.extension() == ".glb";
  if (!(is_binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path.string())
                  : loader.LoadASCIIFromFile(&model, &error, &warning, path.string())))
    throw std::runtime_error(error.empty() ? "it is not a glTF file" : error);
  read_nodes(model, out);
  read_skins(model, out);
  read_clips(model, out);
  read_meshes(model, without, out);
  if (out.triangles.empty()) throw std::runtime_error("it has no triangles");
}

}  // namespace

CharacterFile::CharacterFile(const std::filesystem::path& path, const std::vector<std::string>& without) {
  try {
    read_file(path, without, *this);
  } catch (const std::exception& e) {
    throw std::runtime_error(path.string() + " cannot be read: " + e.what());
  }
}

const Clip* CharacterFile::find_clip(const std::string& name) const {
  if (name.empty()) return clips.empty() ? nullptr : clips.data();
  std::string names;
  for (const Clip& clip : clips) {
    if (clip.name == name) return &clip;
    names += "\n  " + clip.name;
  }
  throw std::runtime_error("there is no clip '" + name + "'; the file has:" + names);
}

Pose CharacterFile::pose(const Clip* clip, float time_s) const {
  std::vector<Node> moved = nodes;
  if (clip)
    for (const Channel& channel : clip->channels) apply(channel, time_s, moved);
  std::vector<glm::mat4> globals(nodes.size());
  for (const int n : parents_first) {
    const Node& node = moved[std::size_t(n)];
    globals[std::size_t(n)] = node.parent < 0 ? local(node) : globals[std::size_t(node.parent)] * local(node);
  }
  Pose pose;
  for (const Skin& skin : skins)
    for (std::size_t j = 0; j < skin.joints.size(); ++j)
      pose.matrices.push_back(globals[std::size_t(skin.joints[j])] * skin.inverse_bind[j]);
  pose.matrices.insert(pose.matrices.end(), globals.begin(), globals.end());
  return pose;
}

std::vector<glm::vec3> CharacterFile::skinned(const Pose& pose) const {
  std::vector<glm::vec3> out;
  out.reserve(vertices.size());
  for (const Vertex& vertex : vertices) {
    glm::vec4 sum(0);
    for (int k = 0; k < 4; ++k)
      sum += vertex.weights[k] * (pose.matrices[vertex.matrices[k]] * glm::vec4(vertex.position, 1));
    out.emplace_back(sum);
  }
  return out;
}

}  // namespace viewer
