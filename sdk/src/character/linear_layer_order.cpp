#include "sdk/src/character/linear_layer_order.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/character/spatial_order.h"

namespace nook {
namespace {

// The normal is scaled to metres; it separates the two sides of a thin limb.
constexpr float normal_scale_metres = 0.05f;

Vector<Place> vertex_places(const CharacterModel& model, Memory* memory) {
  Vector<Place> places(model.vertex_count(), Place{}, memory);
  for (std::size_t v = 0; v < places.size(); ++v) {
    Vec3 position, normal;
    float alpha_sum = 0;
    for (std::size_t e = v * model.influences; e < (v + 1) * model.influences; ++e) {
      if (model.alpha[e] == 0) continue;
      const KeyPoint& point = model.key_points[model.influence[e]];
      position += point.surface_position * model.alpha[e];
      normal += point.surface_normal * model.alpha[e];
      alpha_sum += model.alpha[e];
    }
    if (alpha_sum > 0) position = position * (1 / alpha_sum);
    normal = normalised(normal) * normal_scale_metres;
    places[v] = {position.x, position.y, position.z, normal.x, normal.y, normal.z};
    // Extreme weights overflow, and NaN has no order.
    if (!std::all_of(places[v].begin(), places[v].end(), [](float c) { return std::isfinite(c); }))
      places[v] = {};
  }
  return places;
}

}  // namespace

Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory) {
  const Vector<Place> places = vertex_places(model, memory);
  Vector<std::uint32_t> order(model.vertex_count(), 0, memory);
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  order_in_space(order, block_vertices, places);
  return order;
}

}  // namespace nook
