#include "sdk/src/character/linear_layer_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace nook {
namespace {

// A position in metres, and the normal scaled to metres, which separates the two sides of a thin limb.
using Place = std::array<float, 6>;
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

std::size_t longest_side(std::span<const std::uint32_t> vertices, const Vector<Place>& places) {
  Place low = places[vertices[0]], high = low;
  for (const std::uint32_t v : vertices)
    for (std::size_t a = 0; a < low.size(); ++a) {
      low[a] = std::min(low[a], places[v][a]);
      high[a] = std::max(high[a], places[v][a]);
    }
  std::size_t longest = 0;
  for (std::size_t a = 1; a < low.size(); ++a)
    if (high[a] - low[a] > high[longest] - low[longest]) longest = a;
  return longest;
}

// Both halves are whole blocks, except for the last block. The recursion depth is the logarithm of the number
// of blocks.
void halve(std::span<std::uint32_t> vertices, std::size_t block_vertices, const Vector<Place>& places) {
  if (vertices.size() <= block_vertices) return;
  const std::size_t blocks = (vertices.size() + block_vertices - 1) / block_vertices;
  const std::size_t middle = blocks / 2 * block_vertices;
  const std::size_t side = longest_side(vertices, places);
  std::nth_element(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(middle), vertices.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return places[a][side] != places[b][side] ? places[a][side] < places[b][side] : a < b;
                   });
  halve(vertices.first(middle), block_vertices, places);
  halve(vertices.subspan(middle), block_vertices, places);
}

}  // namespace

Vector<std::uint32_t> linear_layer_order(const CharacterModel& model, std::uint32_t block_vertices,
                                         Memory* memory) {
  const Vector<Place> places = vertex_places(model, memory);
  Vector<std::uint32_t> order(model.vertex_count(), 0, memory);
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = v;
  halve(order, block_vertices, places);
  return order;
}

}  // namespace nook
