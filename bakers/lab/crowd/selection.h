// Which characters of a crowd are measured, and which of them the sheets show.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bakers/lab/crowd/truth.h"

namespace nook::lab::crowd {

// Where a character stands on the ground plane y = 0: x and z in metres.
using Place = glm::vec2;

// The indices of the places that have another place within distance_m.
std::vector<std::uint32_t> with_neighbour_within(std::span<const Place> places, float distance_m);

// The indices of the places nearest to a point, the nearest first, at most count of them.
std::vector<std::uint32_t> nearest_to(std::span<const Place> places, const Place& point, std::size_t count);

// The place that has the most others within distance_m. Of several, the one nearest to the origin.
std::uint32_t busiest(std::span<const Place> places, float distance_m);

// The characters that a report measures.
struct Sample {
  std::vector<std::uint32_t> characters;
  bool have_neighbours = false;  // each has another character within 1 m
};

// Up to 12 characters that have a neighbour, spread over the crowd. If none has a neighbour, the 12 that are
// nearest to the origin.
Sample choose_sample(std::span<const Place> places);

struct View {
  glm::vec3 eye_ws{0}, target_ws{0};
  float fov_rad = 0.5f;  // vertical
};

// The characters that a sheet shows, and the camera that it shows them through.
struct Group {
  std::vector<std::uint32_t> members;
  View view;
};

// Up to 12 characters round the busiest place, seen from where the fewest others stand in the way.
Group choose_group(std::span<const Place> places);

// A square of the floor that reaches margin_m farther than the members' bodies, with side x side points.
FloorPatch floor_under(const Group& group, std::span<const Place> places, float margin_m, std::uint32_t side);

}  // namespace nook::lab::crowd
