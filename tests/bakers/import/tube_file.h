// A closed tube along +y from 0 to 2 with two bones, "root" at y = 0 and "tip" at y = 1: the smallest file
// with all that a character has. Vertices below y = 1 follow the root, those above the tip, the ring at y = 1
// half of each.
#pragma once

#include <cmath>
#include <vector>

#include "bakers/import/gltf.h"
#include "tests/bakers/import/gltf_builder.h"

namespace nook::test {

struct Tube {
  static constexpr int sides = 8;
  static constexpr int rings = 5;
  static constexpr float radius = 0.25f;

  std::vector<float> position;
  std::vector<std::uint8_t> joint;
  std::vector<float> weight;
  std::vector<std::uint16_t> index;

  // The ring's first and last column lie on each other, as at a texture seam.
  static constexpr int columns = sides + 1;
  static constexpr int file_vertices = columns * rings + 2;
  static constexpr int welded_vertices = sides * rings + 2;
  static constexpr int triangles = 2 * sides * (rings - 1) + 2 * sides;

  Tube() {
    for (int r = 0; r < rings; ++r)
      for (int c = 0; c < columns; ++c) {
        const float angle = static_cast<float>(2 * M_PI) * static_cast<float>(c % sides) / sides;
        add_vertex(radius * std::cos(angle), 2.0f * static_cast<float>(r) / (rings - 1),
                   radius * std::sin(angle));
      }
    add_vertex(0, 0, 0);
    add_vertex(0, 2, 0);
    const int bottom = columns * rings;
    for (int c = 0; c < sides; ++c) {
      for (int r = 0; r + 1 < rings; ++r) {
        const int a = r * columns + c;
        add_triangle(a, a + columns, a + 1);
        add_triangle(a + 1, a + columns, a + columns + 1);
      }
      add_triangle(bottom, c, c + 1);
      add_triangle(bottom + 1, (rings - 1) * columns + c + 1, (rings - 1) * columns + c);
    }
  }

 private:
  void add_vertex(float x, float y, float z) {
    position.insert(position.end(), {x, y, z});
    joint.insert(joint.end(), {0, 1, 0, 0});
    const float tip = y < 1 ? 0.0f : y > 1 ? 1.0f : 0.5f;
    weight.insert(weight.end(), {1 - tip, tip, 0, 0});
  }
  void add_triangle(int a, int b, int c) {
    for (const int i : {a, b, c}) index.push_back(static_cast<std::uint16_t>(i));
  }
};

inline std::vector<float> translation_columns(float x, float y, float z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

// Nodes: 0 armature, 1 root, 2 tip, 3 the skinned mesh. One clip, "bend": the tip turns by 90 degrees about z
// in 1 s. Accessors: 0 positions, 1 joints, 2 weights, 3 indices, 4 inverse bind matrices.
inline GltfBuilder tube_file(const Tube& tube = {}) {
  GltfBuilder file;
  const int position = file.add_floats(tube.position, "VEC3");
  const int joint = file.add(tube.joint, "VEC4", 5121);
  const int weight = file.add_floats(tube.weight, "VEC4");
  const int index = file.add(tube.index, "SCALAR", 5123);
  std::vector<float> inverse_bind = translation_columns(0, 0, 0);
  const std::vector<float> tip = translation_columns(0, -1, 0);
  inverse_bind.insert(inverse_bind.end(), tip.begin(), tip.end());
  const int matrices = file.add_floats(inverse_bind, "MAT4");

  file.document["nodes"] = {{{"name", "armature"}, {"children", {1, 3}}},
                            {{"name", "root"}, {"children", Json::array({2})}},
                            {{"name", "tip"}, {"translation", {0, 1, 0}}},
                            {{"name", "body"}, {"mesh", 0}, {"skin", 0}}};
  const Json primitive = {
      {"attributes", {{"POSITION", position}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}}},
      {"indices", index}};
  file.document["meshes"] = Json::array({{{"name", "tube"}, {"primitives", Json::array({primitive})}}});
  file.document["skins"] = Json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}});
  file.add_animation("bend");
  const float h = std::sqrt(0.5f);
  file.add_channel(2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, h, h});
  return file;
}

inline bake::ImportedCharacter load(const GltfBuilder& file) {
  return bake::import_gltf(file.glb());
}

inline float distance(Vec3 a, Vec3 b) {
  return length(a - b);
}

// Enclosed volume by the divergence theorem: positive where triangles face outwards.
inline float signed_volume(const bake::SkinnedMesh& mesh) {
  float volume = 0;
  for (const auto& t : mesh.triangle)
    volume += dot(mesh.position[t[0]], cross(mesh.position[t[1]], mesh.position[t[2]])) / 6;
  return volume;
}

inline bool is_identity(const Mat3x4& m, float tolerance) {
  const Mat3x4 identity;
  for (int i = 0; i < 12; ++i)
    if (!(std::abs(m.m[i] - identity.m[i]) <= tolerance)) return false;
  return true;
}

inline bool has_warning(const std::vector<std::string>& warnings, const std::string& part) {
  for (const std::string& warning : warnings)
    if (warning.find(part) != std::string::npos) return true;
  return false;
}

}  // namespace nook::test
