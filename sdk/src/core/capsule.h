// The convex hull of two spheres, which stands for a part of a body.
#pragma once

#include "sdk/src/core/vec.h"

namespace nook {

// Metres. A sphere is a capsule whose ends are equal.
struct Capsule {
  Vec3 a, b;
  float radius_a = 0, radius_b = 0;
};

// A capsule in world space that casts. It hides a light with its radii, and counts in AO with ao_scale times
// them.
struct PosedCaster {
  Capsule capsule;
  float ao_scale = 1;
};

}  // namespace nook
