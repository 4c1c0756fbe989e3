#include "sdk/src/character/loaded_model.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>
#include <utility>

#include "sdk/src/character/shadow_kernels.h"

namespace nook {
namespace {

using Place = std::array<float, 3>;  // metres

std::size_t longest_side(std::span<const std::uint32_t> indices, const Vector<Place>& places) {
  Place low = places[indices[0]], high = low;
  for (const std::uint32_t v : indices)
    for (std::size_t a = 0; a < low.size(); ++a) {
      low[a] = std::min(low[a], places[v][a]);
      high[a] = std::max(high[a], places[v][a]);
    }
  std::size_t longest = 0;
  for (std::size_t a = 1; a < low.size(); ++a)
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  return longest;
}

// Reorders `indices` so that consecutive blocks contain places that are near each other. All blocks have the
// same size; only the last one may be smaller. Every coordinate must be finite. The recursion depth is O(log
// of the number of blocks).
void order_in_space(std::span<std::uint32_t> indices, std::size_t block, const Vector<Place>& places) {
  if (indices.size() <= block) return;
  const std::size_t blocks = (indices.size() + block - 1) / block;
  const std::size_t middle = blocks / 2 * block;
  const std::size_t side = longest_side(indices, places);
  std::nth_element(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(middle), indices.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return places[a][side] != places[b][side] ? places[a][side] < places[b][side] : a < b;
                   });
  order_in_space(indices.first(middle), block, places);
  order_in_space(indices.subspan(middle), block, places);
}

using Indices = Vector<std::uint32_t>;

std::ptrdiff_t bones_of(const KeyPoint& point) {
  return 4 - std::count(point.weight.begin(), point.weight.end(), 0.0f);
}

// Within a group, key points with many bones come first. Key points are posed four at a time, which is faster
// if all four have few bones.
Indices near_order(const CharacterModel& model, Memory* memory) {
  Vector<Place> places(memory);
  for (const KeyPoint& point : model.key_points)
    places.push_back({point.position.x, point.position.y, point.position.z});
  Indices order(places.size(), 0u, memory);
  std::iota(order.begin(), order.end(), 0u);
  order_in_space(order, key_point_group, places);
  for (std::size_t begin = 0; begin < order.size(); begin += key_point_group)
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(begin),
                     order.begin() + static_cast<std::ptrdiff_t>(
                                         std::min<std::size_t>(begin + key_point_group, order.size())),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return bones_of(model.key_points[a]) > bones_of(model.key_points[b]);
                     });
  return order;
}

Indices inverse_of(const Indices& order, Memory* memory) {
  Indices place(order.size(), 0u, memory);
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  return place;
}

template <class T>
void permute(Vector<T>& values, const Indices& order, Memory* memory) {
  Vector<T> permuted(memory);
  permuted.reserve(order.size());
  for (const std::uint32_t i : order) permuted.push_back(values[i]);
  values = std::move(permuted);
}

// Renumbers the key points of a level. Then sorts its evaluated key points by their new numbers.
void renumber(CharacterLevel& level, const Indices& order, const Indices& place, Memory* memory) {
  const auto new_number = [&](std::uint32_t e) { return place[level.evaluated[e]]; };
  Indices sorted(level.evaluated.size(), 0u, memory);
  std::iota(sorted.begin(), sorted.end(), 0u);
  std::sort(sorted.begin(), sorted.end(),
            [&](std::uint32_t a, std::uint32_t b) { return new_number(a) < new_number(b); });
  const Indices moved = inverse_of(sorted, memory);
  permute(level.evaluated, sorted, memory);
  for (std::uint16_t& k : level.evaluated) k = static_cast<std::uint16_t>(place[k]);
  permute(level.source, order, memory);
  for (std::uint16_t& source : level.source) source = static_cast<std::uint16_t>(moved[source]);
  permute(level.scale, order, memory);
  permute(level.offset, order, memory);
}

}  // namespace

CharacterModel with_near_key_points_together(CharacterModel model, Memory* memory) {
  const Indices order = near_order(model, memory), place = inverse_of(order, memory);
  permute(model.key_points, order, memory);
  // An entry with weight 0 may hold any index, so only valid indices are renumbered.
  for (std::uint16_t& k : model.influence)
    if (k < place.size()) k = static_cast<std::uint16_t>(place[k]);
  for (CharacterLevel& level : model.levels) renumber(level, order, place, memory);
  return model;
}

namespace {

void grow(LoadedModel::BoneBound& bound, Vec3 place, float radius) {
  bound.radius = std::max(bound.radius, length(place - bound.centre) + radius);
}

// Each sphere is centred on the mean of the points that the bone moves. It is not necessarily the smallest
// sphere.
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

// For each chunk of slots of the linear layer, collects the runs of file vertices that read from it.
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
