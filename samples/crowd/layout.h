// Where the characters of a crowd stand: small groups on a jittered grid, close but not inside each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

// One character's place on the ground plane y = 0 and its motion.
struct Placement {
  float x_m = 0, z_m = 0;
  float yaw_rad = 0;  // about +y
  std::uint32_t clip = 0;
  float phase = 0;  // [0, 1)
};

// How far a body reaches from its root in the ground plane, by bearing, over a whole clip. Metres.
struct Outline {
  static constexpr int kBearings = 24;
  std::array<float, kBearings> reach_m{};
  float reach(float bearing_rad) const;  // the largest within 30 degrees
};

std::vector<Outline> clip_outlines(const Hero& hero);

// The same seed gives the same crowd.
std::vector<Placement> make_layout(const std::vector<Outline>& outlines, std::uint32_t count,
                                   std::uint32_t seed);

// Indices of the placements whose nearest other root is within distance_m.
std::vector<std::uint32_t> with_neighbour_within(const std::vector<Placement>& crowd, float distance_m);

// Indices, nearest to a point of the ground plane first, at most count.
std::vector<std::uint32_t> nearest_to(const std::vector<Placement>& crowd, float x_m, float z_m,
                                      std::size_t count);

// The member with the most others within distance_m; the one nearest to the middle if there are several.
std::uint32_t busiest(const std::vector<Placement>& crowd, float distance_m);

}  // namespace crowd
