#include "sdk/src/character/loaded_model.h"

#include <algorithm>

#include "sdk/src/character/key_point_order.h"

namespace nook {
namespace {

void grow(LoadedModel::BoneBound& bound, Vec3 place, float radius) {
  bound.radius = std::max(bound.radius, length(place - bound.centre) + radius);
}

// The bound is centred on the mean of the points that the bone moves; a slightly larger radius than that of
// the smallest sphere is sufficient.
AlignedArray<LoadedModel::BoneBound> make_bone_bounds(const CharacterModel& model, Memory* memory) {
  AlignedArray<LoadedModel::BoneBound> bounds(model.bone_count(), memory);
  Vector<std::uint32_t> count(model.bone_count(), 0u, memory);
  const auto visit = [&](auto&& body) {
    for (const ProxySphere& sphere : model.spheres) body(sphere.bone, sphere.centre, sphere.radius);
    for (const CharacterLevel& level : model.levels)
      for (const ProxySphere& sphere : level.spheres) body(sphere.bone, sphere.centre, sphere.radius);
    for (const KeyPoint& point : model.key_points)
      for (int b = 0; b < KeyPoint::max_bones; ++b) {
        if (point.weight[b] == 0) continue;
        body(point.bone[b], point.position, 0.0f);
        body(point.bone[b], point.surface_position, 0.0f);
      }
  };
  visit([&](std::uint16_t bone, Vec3 place, float) {
    ++count[bone];
    bounds[bone].centre += place;
  });
  for (std::size_t b = 0; b < bounds.size(); ++b) {
    bounds[b].radius = -1;
    if (count[b]) bounds[b].centre = bounds[b].centre * (1 / static_cast<float>(count[b]));
  }
  visit([&](std::uint16_t bone, Vec3 place, float radius) { grow(bounds[bone], place, radius); });
  return bounds;
}

Vector<LoadedLevel> load_levels(const CharacterModel& model, Memory* memory) {
  Vector<LoadedLevel> loaded(memory);
  loaded.reserve(model.levels.size());
  for (const CharacterLevel& level : model.levels) {
    CharacterModel subset(memory);
    subset.bone_names.resize(model.bone_count());
    subset.spheres = level.spheres;
    subset.key_points.reserve(level.evaluated.size());
    for (const std::uint16_t k : level.evaluated) subset.key_points.push_back(model.key_points[k]);
    loaded.emplace_back(subset, memory);
  }
  return loaded;
}

// Maps chunks of slots of the linear layer to runs of file vertices, as one list of lists.
void invert_file_order(LoadedModel& loaded, Memory* memory) {
  constexpr std::uint32_t chunk = LoadedModel::slot_chunk;
  const AlignedArray<std::uint32_t>& slot_of = loaded.linear.file_to_slot();
  const std::size_t slots = loaded.linear.padded_slots(), file_vertices = slot_of.size();
  const auto begins = [&](std::size_t i) { return i == 0 || slot_of[i] / chunk != slot_of[i - 1] / chunk; };
  AlignedArray<std::uint32_t> vertices_before((slots + chunk - 1) / chunk + 1, memory);
  loaded.run_begin = AlignedArray<std::uint32_t>(vertices_before.size(), memory);
  for (std::size_t i = 0; i < file_vertices; ++i) {
    ++vertices_before[slot_of[i] / chunk + 1];
    if (begins(i)) ++loaded.run_begin[slot_of[i] / chunk + 1];
  }
  for (std::size_t c = 1; c < vertices_before.size(); ++c) {
    vertices_before[c] += vertices_before[c - 1];
    loaded.run_begin[c] += loaded.run_begin[c - 1];
  }
  loaded.file_run = AlignedArray<LoadedModel::FileRun>(loaded.run_begin[vertices_before.size() - 1], memory);
  loaded.slot_in_chunk = AlignedArray<std::uint16_t>(file_vertices, memory);
  AlignedArray<std::uint32_t> next_run(vertices_before.size(), memory);
  for (std::size_t i = 0; i < file_vertices; ++i) {
    const std::uint32_t c = slot_of[i] / chunk, entry = vertices_before[c]++;
    loaded.slot_in_chunk[entry] = static_cast<std::uint16_t>(slot_of[i] % chunk);
    if (begins(i))
      loaded.file_run[loaded.run_begin[c] + next_run[c]++] = {static_cast<std::uint32_t>(i), 0, entry};
    ++loaded.file_run[loaded.run_begin[c] + next_run[c] - 1].vertices;
  }
}

}  // namespace

LoadedModel::LoadedModel(CharacterModel loaded, Memory* memory)
    : model(with_near_key_points_together(std::move(loaded), memory)),
      rest_spheres(model, memory),
      rest_key_points(model, memory),
      linear(model, memory),
      groups(model, memory),
      sphere_tree(model, memory),
      levels(load_levels(model, memory)),
      open_without_bias(linear.padded_slots(), memory),
      bone_bounds(make_bone_bounds(model, memory)) {
  std::fill(open_without_bias.begin(), open_without_bias.end(), 1.0f);
  invert_file_order(*this, memory);
  for (std::size_t i = 0; i < model.vertex_count(); ++i) {
    float sum = 0;
    for (std::uint32_t e = 0; e < model.influences; ++e) sum += model.alpha[i * model.influences + e];
    max_alpha_sum = std::max(max_alpha_sum, sum);
  }
  const auto strength = [](const Vector<ProxySphere>& spheres) {
    float sum = 0;
    for (const ProxySphere& sphere : spheres) sum += sphere.caster_weight * sphere.radius * sphere.radius;
    return sum;
  };
  caster_strength = strength(model.spheres);
  for (const CharacterLevel& level : model.levels)
    caster_strength = std::max(caster_strength, strength(level.spheres));
}

}  // namespace nook
