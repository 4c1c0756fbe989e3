// The depth by which a posed body runs through itself, from a few spheres for each bone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/initialise.h"

namespace nook::bake {

class SelfCollision {
 public:
  SelfCollision(const SkinnedMesh& mesh, std::span<const float> vertex_area);

  // The deepest overlap of two spheres of bones that are not neighbours, beyond their overlap at rest, as a
  // share of the smaller radius: 0 apart or touching, 1 sunk in by its radius.
  float depth(const Pose& pose) const;

  // The same without what one hand does to the other: for hands that hold each other or one thing.
  float depth_but_hands(const Pose& pose) const;

 private:
  float deepest(const Pose& pose, bool with_hands) const;

  std::vector<InitialSphere> spheres_;
  std::vector<std::pair<std::uint16_t, std::uint16_t>> pairs_;
  std::vector<float> rest_overlap_;  // a pair, metres
  std::vector<char> is_of_hands_;    // a pair, true between the two hands
};

}  // namespace nook::bake
