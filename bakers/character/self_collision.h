// Measures how deeply a posed body intersects itself, with a few spheres for each bone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/character/initialise.h"
#include "bakers/character/rig_anatomy.h"

namespace nook::bake {

class SelfCollision {
 public:
  SelfCollision(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                const RigCorrections& corrections = {});

  // Returns the deepest overlap of two spheres, minus their overlap in the rest pose. Spheres of bones that
  // are near each other in the hierarchy are not compared. The unit is the smaller radius. At 0, the spheres
  // touch or are apart. At 1, the smaller sphere has sunk in by its radius.
  float depth(const Pose& pose) const;

  // Like depth(), but ignores overlaps between the two hands. Use it for hands that hold each other or one
  // object.
  float depth_but_hands(const Pose& pose) const;

 private:
  float deepest(const Pose& pose, bool with_hands) const;

  std::vector<InitialSphere> spheres_;
  std::vector<std::pair<std::uint16_t, std::uint16_t>> pairs_;
  std::vector<float> rest_overlap_;  // per pair, metres
  std::vector<char> is_of_hands_;    // per pair, true between the two hands
};

}  // namespace nook::bake
