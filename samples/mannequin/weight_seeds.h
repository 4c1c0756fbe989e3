#pragma once

#include <vector>

#include "samples/mannequin/skeleton.h"

namespace nook_samples::mannequin {

/// The weights of a point in the bind pose before any smoothing.
struct WeightSeed {
  struct Share {
    int bone;
    double weight;
  };
  std::vector<Share> shares;  ///< Sums to one.
  double spread_m;  ///< How far weights blend into each other here: about the thickness of the flesh.
  int finger = -1;  ///< Index in left_fingers() on a finger; weights never pass from one finger to another.
};

WeightSeed seed_at(const Vec3& point_m, const Skeleton& skeleton);

}  // namespace nook_samples::mannequin
