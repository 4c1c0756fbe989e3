#include "bakers/character/body_scale.h"

#include <algorithm>
#include <cmath>

namespace nook::bake {
namespace {

void scale_place(Mat3x4& matrix, float scale) {
  for (int row = 0; row < 3; ++row) matrix.m[4 * row + 3] *= scale;
}

}  // namespace

float scale_to_person(const SkinnedMesh& mesh) {
  constexpr float person_m = 1.7f;
  Vec3 low = mesh.position.front(), high = low;
  for (const Vec3 p : mesh.position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
  if (!(extent > 0)) return 1;
  constexpr float most = 40;  // prevents overflow of floats; no unit of length needs as much
  return std::exp2(std::clamp(std::round(std::log2(person_m / extent)), -most, most));
}

SkinnedMesh scaled(const SkinnedMesh& mesh, float scale) {
  SkinnedMesh out = mesh;
  for (Vec3& p : out.position) p = scale * p;
  for (Bone& bone : out.bones) scale_place(bone.frame_rest, scale);
  return out;
}

std::vector<Pose> scaled(std::span<const Pose> poses, float scale) {
  std::vector<Pose> out(poses.begin(), poses.end());
  for (Pose& pose : out)
    for (Mat3x4& bone : pose) scale_place(bone, scale);
  return out;
}

void scale_model(CharacterModel& model, float scale) {
  const auto scale_sphere = [&](ProxySphere& sphere) {
    sphere.centre = scale * sphere.centre;
    sphere.radius *= scale;
  };
  std::for_each(model.spheres.begin(), model.spheres.end(), scale_sphere);
  for (CharacterLevel& level : model.levels)
    std::for_each(level.spheres.begin(), level.spheres.end(), scale_sphere);
  for (KeyPoint& point : model.key_points) {
    point.position = scale * point.position;
    point.surface_position = scale * point.surface_position;
  }
  model.bounding_radius *= scale;
  model.bounding_centre = scale * model.bounding_centre;
}

}  // namespace nook::bake
