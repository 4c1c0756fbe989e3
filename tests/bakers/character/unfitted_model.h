// A model for tests of poses: it takes no bake, and its AO depends on every bone.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "bakers/character/export_model.h"
#include "bakers/import/gltf.h"
#include "bakers/import/skinned_mesh.h"
#include "sdk/src/character/model.h"

namespace nook::test {

// A model that was not fitted, with spheres and key points at random vertices of the body: its AO depends on
// every bone, which is all that poses need.
inline CharacterModel unfitted_model(const bake::ImportedCharacter& character) {
  const bake::SkinnedMesh& mesh = character.mesh;
  std::vector<Vec3> normal;
  bake::vertex_normals(mesh.triangle, mesh.position, normal);
  CharacterModel model;
  for (const bake::Bone& bone : mesh.bones) model.bone_names.emplace_back(bone.name);
  Vec3 low = mesh.position[0], high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  model.bounding_centre = 0.5f * (low + high);
  model.bounding_radius = 0.5f * length(high - low);
  std::mt19937 random(7);
  const auto vertex = [&] { return random() % mesh.vertex_count(); };
  for (int s = 0; s < 100; ++s) {
    const std::size_t v = vertex();
    model.spheres.push_back({mesh.position[v] - normal[v] * (0.04f * model.bounding_radius),
                             0.05f * model.bounding_radius, mesh.weights[v].bone[0], 0.5f});
  }
  constexpr std::uint32_t key_points = 300;
  for (std::uint32_t k = 0; k < key_points; ++k) {
    const std::size_t v = vertex();
    KeyPoint point;
    point.position = point.surface_position = mesh.position[v];
    point.normal = point.surface_normal = normal[v];
    float sum = 0;
    for (int b = 0; b < KeyPoint::max_bones; ++b) {
      point.bone[b] = mesh.weights[v].bone[b];
      sum += point.weight[b] = mesh.weights[v].weight[b];
    }
    for (float& weight : point.weight) weight /= sum;
    model.key_points.push_back(point);
  }
  model.influences = 1;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    model.influence.push_back(static_cast<std::uint16_t>(v % key_points));
    model.alpha.push_back(0.5f);
    model.blend.push_back(1);
    model.bias.push_back(0);
  }
  model.file_to_welded.assign(mesh.file_to_welded.begin(), mesh.file_to_welded.end());
  for (const bake::Primitive& p : mesh.primitives)
    model.primitives.push_back({p.first_vertex, p.vertex_count});
  model.bind = bake::bind_data_of(character);
  model.rest = bake::rest_surface_of(mesh);
  return model;
}

}  // namespace nook::test
