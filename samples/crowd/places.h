// Where the characters of a crowd stand, and their poses there. They form small groups on a jittered grid,
// close together but not inside each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

// One character's place on the ground plane y = 0, and its motion.
struct Placement {
  float x_m = 0, z_m = 0;
  float yaw_rad = 0;  // about +y
  std::uint32_t clip = 0;
  float phase = 0;  // from 0 to 1, at the time 0
};

// The reach of a body from its root in the ground plane over a whole clip, by bearing.
struct Outline {
  static constexpr int bearings = 24;
  std::array<float, bearings> reach_m{};
  // The largest reach within 30 degrees of the bearing.
  float reach(float bearing_rad) const;
};

std::vector<Outline> clip_outlines(const Hero& hero);

// The same seed gives the same crowd.
std::vector<Placement> make_layout(const std::vector<Outline>& outlines, std::uint32_t count,
                                   std::uint32_t seed);

// Returns the distance of the farthest root from the origin, plus room for the body.
float crowd_radius_m(const std::vector<Placement>& places);

// The pose of a character's clip at a time, moved to the character's place in the world.
Bones placed_pose(const Hero& hero, const Placement& placement, float time_s);

// The placed poses of all characters.
std::vector<Bones> pose_crowd(const Hero& hero, const std::vector<Placement>& places, float time_s);

}  // namespace crowd
