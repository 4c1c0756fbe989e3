#include "samples/crowd/animation.h"

#include <cmath>

namespace crowd {

Bones placed_pose(const Hero& hero, const Placement& placement, float time_s) {
  const float duration_s = hero.clips()[placement.clip].duration_s;
  const float loops = placement.phase + (duration_s > 0 ? time_s / duration_s : 0);
  Bones bones = hero.pose(placement.clip, loops - std::floor(loops));
  const float c = std::cos(placement.yaw_rad), s = std::sin(placement.yaw_rad);
  for (std::size_t b = 0; b < bones.size(); b += 12)
    for (std::size_t column = 0; column < 4; ++column) {
      float& x = bones[b + column];
      float& z = bones[b + 8 + column];
      const float rotated = c * x + s * z;
      z = -s * x + c * z;
      x = rotated;
    }
  for (std::size_t b = 0; b < bones.size(); b += 12) {
    bones[b + 3] += placement.x_m;
    bones[b + 11] += placement.z_m;
  }
  return bones;
}

}  // namespace crowd
