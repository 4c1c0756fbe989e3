#include "tests/bakers/tool/glb_tube.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

namespace {

using Json = nlohmann::ordered_json;

constexpr int rings = 14, segments = 10, vertices = rings * segments;
enum ComponentType { unsigned_byte = 5121, unsigned_short = 5123, real = 5126 };

// Appends arrays to one buffer, with a view and an accessor for each.
class Arrays {
 public:
  template <class T>
  int add(const std::vector<T>& values, ComponentType type, const char* shape, int count,
          const Json& low_high = {}) {
    while (bytes_.size() % 4) bytes_ += '\0';
    views_.push_back(
        {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size() * sizeof(T)}});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    Json accessor{
        {"bufferView", views_.size() - 1}, {"componentType", int(type)}, {"count", count}, {"type", shape}};
    if (!low_high.is_null()) {
      accessor["min"] = low_high[0];
      accessor["max"] = low_high[1];
    }
    accessors_.push_back(accessor);
    return int(accessors_.size()) - 1;
  }
  void finish(Json& file) const {
    file["bufferViews"] = views_;
    file["accessors"] = accessors_;
    file["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

void append_u32(std::string& out, std::size_t value) {
  const auto v = std::uint32_t(value);
  out.append(reinterpret_cast<const char*>(&v), 4);
}

std::string glb(const Json& file, std::string bytes) {
  std::string text = file.dump();
  while (text.size() % 4) text += ' ';
  while (bytes.size() % 4) bytes += '\0';
  std::string out = "glTF";
  append_u32(out, 2);
  append_u32(out, 12 + 8 + text.size() + 8 + bytes.size());
  append_u32(out, text.size());
  out += "JSON" + text;
  append_u32(out, bytes.size());
  out += std::string("BIN\0", 4) + bytes;
  return out;
}

}  // namespace

std::string glb_tube(const std::vector<std::string>& clips, bool skin) {
  std::vector<float> position, weight;
  std::vector<std::uint8_t> joint;
  std::vector<std::uint16_t> index;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < segments; ++s) {
      const float x = float(r) / (rings - 1), angle = 6.2831853f * float(s) / segments;
      const float tip = std::fmin(std::fmax((x - 0.4f) / 0.2f, 0.0f), 1.0f);
      position.insert(position.end(), {x, 0.1f * std::cos(angle), 0.1f * std::sin(angle)});
      weight.insert(weight.end(), {1 - tip, tip, 0, 0});
      joint.insert(joint.end(), {0, 1, 0, 0});
      if (r + 1 == rings) continue;
      const int a = r * segments + s, b = r * segments + (s + 1) % segments;
      for (int v : {a, b, a + segments, b, b + segments, a + segments}) index.push_back(std::uint16_t(v));
    }
  Arrays arrays;
  Json file;
  file["asset"] = {{"version", "2.0"}};
  Json attributes;
  attributes["POSITION"] =
      arrays.add(position, real, "VEC3", vertices,
                 Json::array({Json::array({0, -0.1, -0.1}), Json::array({1, 0.1, 0.1})}));
  attributes["JOINTS_0"] = arrays.add(joint, unsigned_byte, "VEC4", vertices);
  attributes["WEIGHTS_0"] = arrays.add(weight, real, "VEC4", vertices);
  const int indices = arrays.add(index, unsigned_short, "SCALAR", int(index.size()));
  file["meshes"] =
      Json::array({{{"primitives", Json::array({{{"attributes", attributes}, {"indices", indices}}})}}});
  Json body{{"mesh", 0}, {"name", "body"}};
  if (skin) body["skin"] = 0;
  file["nodes"] = Json::array(
      {body, {{"name", "root"}, {"children", {2}}}, {{"name", "tip"}, {"translation", {0.5, 0, 0}}}});
  file["scenes"] = Json::array({{{"nodes", {0, 1}}}});
  file["scene"] = 0;
  if (skin) {
    std::vector<float> inverse_bind(32, 0.0f);
    for (std::size_t m = 0; m < 2; ++m)
      for (std::size_t i = 0; i < 4; ++i) inverse_bind[16 * m + 5 * i] = 1;
    inverse_bind[16 + 12] = -0.5f;
    file["skins"] = Json::array(
        {{{"joints", {1, 2}}, {"inverseBindMatrices", arrays.add(inverse_bind, real, "MAT4", 2)}}});
  }
  for (std::size_t c = 0; c < clips.size(); ++c) {
    const float half_angle = 0.4f + 0.2f * float(c);
    const int times = arrays.add(std::vector<float>{0, 1}, real, "SCALAR", 2,
                                 Json::array({Json::array({0}), Json::array({1})}));
    const int turns = arrays.add(
        std::vector<float>{0, 0, 0, 1, 0, 0, std::sin(half_angle), std::cos(half_angle)}, real, "VEC4", 2);
    file["animations"].push_back(
        {{"name", clips[c]},
         {"samplers", Json::array({{{"input", times}, {"output", turns}}})},
         {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}})}});
  }
  arrays.finish(file);
  return glb(file, arrays.bytes());
}

namespace {

struct PersonJoint {
  const char* name;
  int parent;  // -1: none
  float x, y, z;
};

// A person who stands in a T-pose and looks along +z; y is up, in metres.
constexpr PersonJoint person[] = {{"Hips", -1, 0, 1, 0},
                                  {"Spine", 0, 0, 1.15f, 0},
                                  {"Chest", 1, 0, 1.32f, 0},
                                  {"Neck", 2, 0, 1.5f, 0},
                                  {"Head", 3, 0, 1.62f, 0},
                                  {"LeftUpLeg", 0, 0.1f, 0.92f, 0},
                                  {"LeftLeg", 5, 0.1f, 0.5f, 0},
                                  {"LeftFoot", 6, 0.1f, 0.08f, 0},
                                  {"LeftShoulder", 2, 0.07f, 1.44f, 0},
                                  {"LeftArm", 8, 0.2f, 1.44f, 0},
                                  {"LeftForeArm", 9, 0.45f, 1.44f, 0},
                                  {"LeftHand", 10, 0.7f, 1.44f, 0},
                                  {"RightUpLeg", 0, -0.1f, 0.92f, 0},
                                  {"RightLeg", 12, -0.1f, 0.5f, 0},
                                  {"RightFoot", 13, -0.1f, 0.08f, 0},
                                  {"RightShoulder", 2, -0.07f, 1.44f, 0},
                                  {"RightArm", 15, -0.2f, 1.44f, 0},
                                  {"RightForeArm", 16, -0.45f, 1.44f, 0},
                                  {"RightHand", 17, -0.7f, 1.44f, 0}};

}  // namespace

std::string glb_person() {
  constexpr float radius = 0.07f;
  // The corners of an octahedron are +x, -x, +y, -y, +z, -z.
  constexpr int corners = 6, faces[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                            {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  std::vector<float> position, weight, inverse_bind;
  std::vector<std::uint8_t> joint_of;
  std::vector<std::uint16_t> index;
  Json nodes = Json::array({{{"mesh", 0}, {"name", "body"}, {"skin", 0}}}), joints = Json::array();
  float low[3] = {9, 9, 9}, high[3] = {-9, -9, -9};
  for (int j = 0; j < int(std::size(person)); ++j) {
    const PersonJoint& at = person[j];
    const float place[3] = {at.x, at.y, at.z};
    const PersonJoint origin{"", -1, 0, 0, 0};
    const PersonJoint& parent = at.parent < 0 ? origin : person[at.parent];
    nodes.push_back(
        {{"name", at.name}, {"translation", {at.x - parent.x, at.y - parent.y, at.z - parent.z}}});
    joints.push_back(j + 1);
    if (at.parent >= 0) nodes[std::size_t(at.parent) + 1]["children"].push_back(j + 1);
    inverse_bind.insert(inverse_bind.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at.x, -at.y, -at.z, 1});
    for (int c = 0; c < corners; ++c) {
      for (int axis = 0; axis < 3; ++axis) {
        const float side = c / 2 == axis ? (c % 2 ? -radius : radius) : 0;
        position.push_back(place[axis] + side);
        low[axis] = std::fmin(low[axis], position.back());
        high[axis] = std::fmax(high[axis], position.back());
      }
      joint_of.insert(joint_of.end(), {std::uint8_t(j), 0, 0, 0});
      weight.insert(weight.end(), {1, 0, 0, 0});
    }
    for (const auto& face : faces)
      for (const int corner : face) index.push_back(std::uint16_t(corners * j + corner));
  }
  Arrays arrays;
  Json file;
  file["asset"] = {{"version", "2.0"}};
  const int vertices_of_person = corners * int(std::size(person));
  Json attributes;
  attributes["POSITION"] = arrays.add(position, real, "VEC3", vertices_of_person, Json::array({low, high}));
  attributes["JOINTS_0"] = arrays.add(joint_of, unsigned_byte, "VEC4", vertices_of_person);
  attributes["WEIGHTS_0"] = arrays.add(weight, real, "VEC4", vertices_of_person);
  const int indices = arrays.add(index, unsigned_short, "SCALAR", int(index.size()));
  file["meshes"] =
      Json::array({{{"primitives", Json::array({{{"attributes", attributes}, {"indices", indices}}})}}});
  file["nodes"] = nodes;
  file["scenes"] = Json::array({{{"nodes", {0, 1}}}});
  file["scene"] = 0;
  file["skins"] = Json::array(
      {{{"joints", joints},
        {"inverseBindMatrices", arrays.add(inverse_bind, real, "MAT4", int(std::size(person)))}}});
  arrays.finish(file);
  return glb(file, arrays.bytes());
}
