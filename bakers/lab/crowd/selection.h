// Chooses the characters to measure and the characters to show on the sheets.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "bakers/lab/crowd/truth.h"

namespace nook::lab::crowd {

// The position of a character on the ground plane y = 0: x and z in metres.
using Place = glm::vec2;

// Returns the indices of the places that have another place within distance_m.
std::vector<std::uint32_t> with_neighbour_within(std::span<const Place> places, float distance_m);

// Returns the indices of the `count` places that are nearest to a point, the nearest first.
std::vector<std::uint32_t> nearest_to(std::span<const Place> places, const Place& point, std::size_t count);

// Returns the index of the place that has the most other places within distance_m. If several places have
// equally many, returns the one nearest to the origin.
std::uint32_t busiest(std::span<const Place> places, float distance_m);

// The characters that a report measures.
struct Sample {
  std::vector<std::uint32_t> characters;
  bool have_neighbours = false;  // whether each of them has another character within 1 m
};

// Chooses up to 12 characters with a neighbour, spread over the crowd. If none has a neighbour, takes the 12
// nearest to the origin.
Sample choose_sample(std::span<const Place> places);

struct View {
  glm::vec3 eye_ws{0}, target_ws{0};
  float fov_rad = 0.5f;  // vertical
};

// The characters that a sheet shows, and the camera.
struct Group {
  std::vector<std::uint32_t> members;
  View view;
};

// Chooses up to 12 characters around the busiest place. The camera is placed where the fewest other bodies
// block the view.
Group choose_group(std::span<const Place> places);

// Returns a square of the floor with `side` x `side` points. It extends margin_m beyond the bodies of the
// group.
FloorPatch floor_under(const Group& group, std::span<const Place> places, float margin_m, std::uint32_t side);

}  // namespace nook::lab::crowd
