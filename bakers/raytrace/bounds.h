// The box round points.
#pragma once

#include <algorithm>
#include <span>

#include "sdk/src/core/vec.h"

namespace nook::bake {

struct Bounds {
  Vec3 low, high;
};

// points has one or more.
inline Bounds bounds_of(std::span<const Vec3> points) {
  Bounds b{points.front(), points.front()};
  for (const Vec3 p : points) {
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y), std::min(b.low.z, p.z)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y), std::max(b.high.z, p.z)};
  }
  return b;
}

}  // namespace nook::bake
