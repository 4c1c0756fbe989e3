#include "bakers/character/self_collision.h"

#include <algorithm>

namespace nook::bake {
namespace {

// Bones this near in the hierarchy share flesh: their spheres always overlap.
constexpr int related_hops = 2;

bool related(const SkinnedMesh& mesh, std::size_t a, std::size_t b) {
  std::vector<std::size_t> up_a{a}, up_b{b};
  for (int i = 0; i < related_hops && mesh.bones[up_a.back()].parent >= 0; ++i)
    up_a.push_back(std::size_t(mesh.bones[up_a.back()].parent));
  for (int i = 0; i < related_hops && mesh.bones[up_b.back()].parent >= 0; ++i)
    up_b.push_back(std::size_t(mesh.bones[up_b.back()].parent));
  for (std::size_t i = 0; i < up_a.size(); ++i)
    for (std::size_t j = 0; j < up_b.size(); ++j)
      if (up_a[i] == up_b[j] && i + j <= std::size_t(related_hops)) return true;
  return false;
}

float overlap(Vec3 a, float radius_a, Vec3 b, float radius_b) {
  return radius_a + radius_b - length(a - b);
}

}  // namespace

SelfCollision::SelfCollision(const SkinnedMesh& mesh, std::span<const float> vertex_area)
    : spheres_(initial_spheres(mesh, vertex_area, 100)) {
  // The spread of points on a round limb's skin is its radius over sqrt(2).
  for (InitialSphere& s : spheres_) s.radius *= 1.414f;
  for (std::size_t i = 0; i < spheres_.size(); ++i)
    for (std::size_t j = i + 1; j < spheres_.size(); ++j) {
      if (related(mesh, spheres_[i].bone, spheres_[j].bone)) continue;
      pairs_.push_back({std::uint16_t(i), std::uint16_t(j)});
      rest_overlap_.push_back(std::max(
          0.0f, overlap(spheres_[i].centre, spheres_[i].radius, spheres_[j].centre, spheres_[j].radius)));
    }
}

float SelfCollision::depth(const Pose& pose) const {
  std::vector<Vec3> centre(spheres_.size());
  for (std::size_t i = 0; i < centre.size(); ++i)
    centre[i] = transform_point(pose[spheres_[i].bone], spheres_[i].centre);
  float deepest = 0;
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    const auto [i, j] = pairs_[p];
    const float radius_i = spheres_[i].radius, radius_j = spheres_[j].radius;
    const float more = overlap(centre[i], radius_i, centre[j], radius_j) - rest_overlap_[p];
    deepest = std::max(deepest, more / std::min(radius_i, radius_j));
  }
  return deepest;
}

}  // namespace nook::bake
