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

}  // namespace crowd
