#include "sdk/src/character/key_point_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "sdk/src/character/shadow_kernels.h"
#include "sdk/src/character/spatial_order.h"

namespace nook {
namespace {

using Indices = Vector<std::uint32_t>;

std::ptrdiff_t bones_of(const KeyPoint& point) {
  return 4 - std::count(point.weight.begin(), point.weight.end(), 0.0f);
}

// Within a group those of many bones come first, because four of few bones are posed faster.
Indices near_order(const CharacterModel& model, Memory* memory) {
  Vector<Place> places(memory);
  for (const KeyPoint& point : model.key_points)
    places.push_back({point.position.x, point.position.y, point.position.z, 0, 0, 0});
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

// A level's key points are in ascending order, in the new numbers as in the old ones.
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
  // Entries without weight may have any index.
  for (std::uint16_t& k : model.influence)
    if (k < place.size()) k = static_cast<std::uint16_t>(place[k]);
  for (CharacterLevel& level : model.levels) renumber(level, order, place, memory);
  return model;
}

}  // namespace nook
