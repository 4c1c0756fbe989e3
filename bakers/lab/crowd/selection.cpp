#include "bakers/lab/crowd/selection.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nook::lab::crowd {
namespace {

constexpr std::size_t sample_size = 12, group_size = 12;
constexpr float near_m = 1.0f;

constexpr float group_distance_m = 4.6f;  // distance from the camera to the group
constexpr int bearings = 24;              // number of directions that the camera may look from
constexpr float body_reach_m = 1.2f;      // distance from a character's root to its fingers and toes

float squared_distance(const Place& a, const Place& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

// Returns a measure of how much the other characters block the view from a camera at this bearing to the
// focus.
float obstruction(std::span<const Place> places, const Place& focus, float bearing_rad) {
  const float s = std::sin(bearing_rad), c = std::cos(bearing_rad);
  float sum = 0;
  for (const Place& p : places) {
    const float dx = p.x - focus.x, dz = p.y - focus.y;
    const float ahead_m = dx * s + dz * c, aside_m = std::abs(dx * c - dz * s);
    if (ahead_m > 0.8f && ahead_m < group_distance_m + 1.0f && aside_m < 1.1f) sum += 1.0f + ahead_m;
  }
  return sum;
}

float clearest_bearing(std::span<const Place> places, const Place& focus) {
  float best = 0, best_obstruction = INFINITY;
  for (int k = 0; k < bearings; ++k) {
    const float bearing = 6.2831853f * float(k) / bearings;
    const float found = obstruction(places, focus, bearing);
    if (found < best_obstruction) {
      best = bearing;
      best_obstruction = found;
    }
  }
  return best;
}

}  // namespace

std::vector<std::uint32_t> with_neighbour_within(std::span<const Place> places, float distance_m) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    for (std::uint32_t j = 0; j < places.size(); ++j)
      if (i != j && squared_distance(places[i], places[j]) <= distance_m * distance_m) {
        found.push_back(i);
        break;
      }
  return found;
}

std::vector<std::uint32_t> nearest_to(std::span<const Place> places, const Place& point, std::size_t count) {
  std::vector<std::uint32_t> order(places.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return squared_distance(places[a], point) < squared_distance(places[b], point);
  });
  order.resize(std::min(count, order.size()));
  return order;
}

std::uint32_t busiest(std::span<const Place> places, float distance_m) {
  std::uint32_t best = 0;
  float best_score = -1;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    float score = 0;
    for (const Place& other : places)
      if (squared_distance(places[i], other) <= distance_m * distance_m) score += 1;
    // Prefers places near the origin. The penalty is smaller than the score of one neighbour, so it only
    // decides between places with equally many neighbours.
    score -= 0.5f * std::min(1.0f, std::hypot(places[i].x, places[i].y) / 100);
    if (score > best_score) {
      best_score = score;
      best = i;
    }
  }
  return best;
}

Sample choose_sample(std::span<const Place> places) {
  std::vector<std::uint32_t> candidates = with_neighbour_within(places, near_m);
  Sample sample;
  sample.have_neighbours = !candidates.empty();
  if (candidates.empty()) candidates = nearest_to(places, {0, 0}, sample_size);
  const std::size_t count = std::min(sample_size, candidates.size());
  for (std::size_t i = 0; i < count; ++i)
    sample.characters.push_back(candidates[i * candidates.size() / count]);
  return sample;
}

Group choose_group(std::span<const Place> places) {
  const Place& focus = places[busiest(places, near_m)];
  const float bearing = clearest_bearing(places, focus);
  Group group;
  group.view.target_ws = {focus.x, 0.82f, focus.y};
  group.view.eye_ws =
      group.view.target_ws + group_distance_m * glm::vec3(std::sin(bearing), 0.28f, std::cos(bearing));
  group.members = nearest_to(places, focus, group_size);
  // A body directly in front of the camera would hide the group, so it is not drawn. It still darkens the
  // other bodies.
  std::erase_if(group.members, [&](std::uint32_t i) {
    return std::hypot(places[i].x - group.view.eye_ws.x, places[i].y - group.view.eye_ws.z) <
           0.6f * group_distance_m;
  });
  return group;
}

FloorPatch floor_under(const Group& group, std::span<const Place> places, float margin_m,
                       std::uint32_t side) {
  glm::vec2 low(INFINITY), high(-INFINITY);
  for (const std::uint32_t member : group.members) {
    low = glm::min(low, places[member]);
    high = glm::max(high, places[member]);
  }
  const float reach_m = margin_m + body_reach_m;
  const float size_m = std::max(high.x - low.x, high.y - low.y) + 2 * reach_m;
  return {low.x - reach_m, low.y - reach_m, size_m, side};
}

}  // namespace nook::lab::crowd
