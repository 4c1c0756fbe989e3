// Small character models with known numbers, for tests that need no bake.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>

#include "sdk/src/character/model.h"
#include "sdk/src/core/affine.h"

namespace nook::test {

// Reproducible numbers on every platform (Numerical Recipes' linear congruential generator).
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  std::uint32_t next() { return state_ = state_ * 1664525u + 1013904223u; }
  float between(float low, float high) {
    return low + (high - low) * static_cast<float>(next() >> 8) / 16777216.0f;
  }
  std::uint32_t below(std::uint32_t count) { return (next() >> 8) % count; }
  Vec3 place(float half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = place(1);
      if (length(v) > 0.1f && length(v) <= 1) return normalised(v);
    }
  }

 private:
  std::uint32_t state_;
};

struct SampleSize {
  std::uint32_t bones = 5, spheres = 7, key_points = 12, vertices = 40, repeats = 10, influences = 4;
};

// A turn about a random axis and a move, as rows of a matrix.
inline Mat3x4 random_frame(Numbers& numbers, float scale = 1) {
  const Vec3 x = numbers.direction();
  const Vec3 z = normalised(cross(x, numbers.direction())), y = cross(z, x), t = numbers.place(0.3f);
  return {{scale * x.x, scale * y.x, scale * z.x, t.x, scale * x.y, scale * y.y, scale * z.y, t.y,
           scale * x.z, scale * y.z, scale * z.z, t.z}};
}

// Two spaces, of metres and of centimetres, a skin of all bones from the last on, a second skin of the first
// bone, and rest vertices of up to three bones.
inline void add_bind_data(CharacterModel& model, Numbers& numbers) {
  BindData& bind = model.bind;
  const auto bones = static_cast<std::uint32_t>(model.bone_count());
  for (std::uint32_t b = 0; b < bones; ++b)
    bind.bones.push_back({random_frame(numbers), static_cast<std::uint16_t>(b)});
  bind.rest_from_mesh = {random_frame(numbers), random_frame(numbers, 0.01f)};
  for (std::size_t p = 0; p < model.primitives.size(); ++p)
    bind.primitive_space.push_back(static_cast<std::uint16_t>(p % 2));
  bind.skins = {{1, 1, 0, bones}, {3, 0, bones, 1}};
  for (std::uint32_t b = bones; b-- > 0;) bind.bone_of_joint.push_back(static_cast<std::uint16_t>(b));
  bind.bone_of_joint.push_back(0);
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    model.rest.position.push_back(numbers.place(0.5f));
    model.rest.normal.push_back(numbers.direction());
  }
  for (std::uint32_t v = 0; v < 12; ++v) {
    RestVertex vertex;
    vertex.file_vertex = numbers.below(static_cast<std::uint32_t>(model.file_to_welded.size()));
    vertex.position = model.rest.position[model.file_to_welded[vertex.file_vertex]];
    vertex.bone_count = 1 + v % 3;
    for (std::uint32_t b = 0; b < vertex.bone_count; ++b) {
      vertex.bone[b] = static_cast<std::uint16_t>((v + b) % bones);
      vertex.weight[b] =
          vertex.bone_count == 1 ? 1.0f : (b == 0 ? 0.5f : 0.5f / float(vertex.bone_count - 1));
    }
    bind.vertices.push_back(vertex);
  }
}

// Close vertices where the rest positions are; every other one has weights.
inline void add_close_vertices(CharacterModel& model) {
  BindData& bind = model.bind;
  const auto bones = static_cast<std::uint32_t>(model.bone_count());
  for (std::uint32_t v = 0; v < 6 && v < model.vertex_count(); ++v) {
    CloseVertex vertex;
    vertex.welded = v;
    std::uint32_t first = 0;
    while (model.file_to_welded[first] != v) ++first;
    std::size_t primitive = 0;
    while (first - model.primitives[primitive].first_vertex >= model.primitives[primitive].vertex_count)
      ++primitive;
    vertex.space = bind.primitive_space[primitive];
    const Affine mesh_from_rest = inverse(to_double(bind.rest_from_mesh[vertex.space]));
    vertex.mesh_position = transform(mesh_from_rest, model.rest.position[v]);
    vertex.weights.count = v % 2 == 0 ? 0 : 1 + v % 3;
    for (std::uint32_t b = 0; b < vertex.weights.count; ++b) {
      vertex.weights.bone[b] = static_cast<std::uint16_t>((v + b) % bones);
      vertex.weights.weight[b] = 1.0f / static_cast<float>(vertex.weights.count);
    }
    bind.close.push_back(vertex);
  }
}

// Capsules and spheres, one or two for each bone.
inline void add_world_casters(CharacterModel& model, Numbers& numbers) {
  for (std::size_t b = 0; b < model.bone_count(); ++b)
    for (std::size_t i = 0; i < 1 + b % 2; ++i) {
      WorldCaster& caster = model.world_casters.emplace_back();
      caster.bone = static_cast<std::uint16_t>(b);
      caster.capsule.a = numbers.place(0.5f);
      caster.capsule.b = i == 0 ? caster.capsule.a + numbers.place(0.2f) : caster.capsule.a;
      caster.capsule.radius_a = numbers.between(0.03f, 0.1f);
      caster.capsule.radius_b = numbers.between(0.03f, 0.1f);
      caster.ao_scale = numbers.between(0.6f, 1.1f);
    }
}

// Vectors of any length up to 1.
inline void add_occluded(CharacterModel& model, Numbers& numbers) {
  for (std::size_t v = 0; v < model.vertex_count(); ++v) {
    const Vec3 dark = numbers.direction() * numbers.between(0, 0.6f);
    model.occluded.push_back({dark, numbers.direction() * numbers.between(0, 0.2f)});
  }
}

// Spheres, key points and weights at random in a box of a metre; `repeats` file vertices are second copies.
inline CharacterModel sample_model(std::uint32_t seed = 1, SampleSize size = {}) {
  Numbers numbers(seed);
  CharacterModel model;
  for (std::uint32_t b = 0; b < size.bones; ++b)
    model.bone_names.emplace_back(("skeleton:bone_" + std::to_string(b)).c_str());
  for (std::uint32_t s = 0; s < size.spheres; ++s)
    model.spheres.push_back({numbers.place(0.4f), numbers.between(0.03f, 0.15f),
                             static_cast<std::uint16_t>(numbers.below(size.bones)),
                             numbers.between(0.2f, 0.9f)});
  for (std::uint32_t k = 0; k < size.key_points; ++k) {
    KeyPoint point;
    point.position = numbers.place(0.5f);
    point.normal = numbers.direction();
    point.surface_position = point.position + numbers.place(0.02f);
    point.surface_normal = numbers.direction();
    const std::uint32_t used = 1 + numbers.below(KeyPoint::max_bones);
    float sum = 0;
    for (std::uint32_t b = 0; b < used; ++b) {
      point.bone[b] = static_cast<std::uint16_t>(numbers.below(size.bones));
      sum += point.weight[b] = numbers.between(0.1f, 1);
    }
    for (float& weight : point.weight) weight /= sum;
    point.saturation = numbers.between(0, 2);
    model.key_points.push_back(point);
  }
  model.influences = size.influences;
  for (std::uint32_t v = 0; v < size.vertices; ++v) {
    const std::uint32_t used = 1 + numbers.below(size.influences), first = numbers.below(size.key_points);
    for (std::uint32_t e = 0; e < size.influences; ++e) {
      model.influence.push_back(static_cast<std::uint16_t>(e < used ? (first + e) % size.key_points : 0));
      model.alpha.push_back(e < used ? numbers.between(0.001f, 0.6f) : 0.0f);
      model.blend.push_back(e < used ? numbers.between(-0.1f, 0.3f) : 0.0f);
    }
    float blend_sum = 0;
    for (std::uint32_t e = 1; e < used; ++e)
      blend_sum += model.blend[model.blend.size() - size.influences + e];
    model.blend[model.blend.size() - size.influences] = 1 - blend_sum;
    model.bias.push_back(numbers.between(-0.1f, 0.2f));
    model.static_ao.push_back(numbers.between(0, 1));
    model.file_to_welded.push_back(v);
    if (numbers.below(size.vertices) < size.repeats) model.file_to_welded.push_back(numbers.below(v + 1));
  }
  const auto file_vertices = static_cast<std::uint32_t>(model.file_to_welded.size());
  model.primitives = {{0, file_vertices / 3}, {file_vertices / 3, file_vertices - file_vertices / 3}};
  model.bounding_radius = 0.9f;
  add_bind_data(model, numbers);
  add_close_vertices(model);
  model.recipe = "{\"preset\": \"test\"}";
  return model;
}

// One bone, one sphere, and one upward key point at the origin that one vertex takes in full.
inline CharacterModel single_model(Vec3 sphere_centre, float sphere_radius, float alpha = 1, float bias = 0) {
  CharacterModel model;
  model.bone_names.emplace_back("root");
  model.spheres.push_back({sphere_centre, sphere_radius, 0, 1});
  KeyPoint point;
  point.normal = point.surface_normal = {0, 1, 0};
  point.weight[0] = 1;
  model.key_points.push_back(point);
  model.influences = 1;
  model.influence = {0};
  model.alpha = {alpha};
  model.blend = {1};
  model.bias = {bias};
  model.file_to_welded = {0};
  model.primitives = {{0, 1}};
  model.bounding_radius = length(sphere_centre) + sphere_radius;
  return model;
}

}  // namespace nook::test
