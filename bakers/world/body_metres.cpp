#include "bakers/world/body_metres.h"

#include <algorithm>
#include <cmath>

#include "bakers/raytrace/ray_scene.h"

namespace nook::bake {

float scale_to_metres(const SkinnedMesh& mesh) {
  constexpr float person_m = 1.7f, most_times = 8;
  if (mesh.position.empty()) return 1;
  const Bounds box = bounds_of(mesh.position);
  const float extent = std::max({box.high.x - box.low.x, box.high.y - box.low.y, box.high.z - box.low.z});
  // Also true if a position is not finite.
  if (!(extent > 0 && extent < 1e12f)) return 1;
  if (extent * most_times > person_m && extent < most_times * person_m) return 1;
  return std::exp2(std::round(std::log2(person_m / std::max(extent, 1e-12f))));
}

SkinnedMesh mesh_in_metres(const SkinnedMesh& mesh, float scale) {
  SkinnedMesh out = mesh;
  for (Vec3& p : out.position) p = scale * p;
  return out;
}

std::vector<Pose> poses_in_metres(std::span<const Pose> poses, float scale) {
  std::vector<Pose> out(poses.begin(), poses.end());
  for (Pose& pose : out)
    for (Mat3x4& bone : pose)
      for (int row = 0; row < 3; ++row) bone.m[4 * row + 3] *= scale;
  return out;
}

std::vector<WorldCaster> casters_in_metres(std::span<const WorldCaster> casters, float scale) {
  std::vector<WorldCaster> out(casters.begin(), casters.end());
  for (WorldCaster& caster : out) {
    Capsule& c = caster.capsule;
    c = {scale * c.a, scale * c.b, scale * c.radius_a, scale * c.radius_b};
  }
  return out;
}

}  // namespace nook::bake
