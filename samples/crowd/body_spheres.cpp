#include "samples/crowd/body_spheres.h"

#include <algorithm>
#include <cmath>

namespace crowd {
namespace {

constexpr float kThinnest_m = 0.025f;

std::vector<std::vector<glm::vec3>> vertices_by_bone(const Hero& hero) {
  std::vector<std::vector<glm::vec3>> of_bone(hero.bone_count());
  for (std::size_t v = 0; v < hero.vertex_count(); ++v) {
    const float* weights = &hero.weights[4 * v];
    const auto strongest = std::max_element(weights, weights + 4) - weights;
    const float* p = &hero.positions_m[3 * v];
    of_bone[hero.joints[4 * v + std::size_t(strongest)]].push_back({p[0], p[1], p[2]});
  }
  return of_bone;
}

// The direction in which points spread most, by a few steps of the power method.
glm::vec3 long_axis(const std::vector<glm::vec3>& points, const glm::vec3& centre) {
  glm::vec3 axis(0.5f, 0.7f, 0.5f);
  for (int step = 0; step < 12; ++step) {
    glm::vec3 next(0);
    for (const glm::vec3& p : points) next += (p - centre) * glm::dot(p - centre, axis);
    if (!(glm::dot(next, next) > 0)) return glm::vec3(0, 1, 0);
    axis = glm::normalize(next);
  }
  return axis;
}

}  // namespace

std::vector<BodySphere> body_spheres(const Hero& hero) {
  std::vector<BodySphere> spheres;
  const std::vector<std::vector<glm::vec3>> of_bone = vertices_by_bone(hero);
  for (std::uint32_t bone = 0; bone < of_bone.size(); ++bone) {
    const std::vector<glm::vec3>& points = of_bone[bone];
    if (points.size() < 8) continue;
    glm::vec3 centre(0);
    for (const glm::vec3& p : points) centre += p / float(points.size());
    const glm::vec3 axis = long_axis(points, centre);
    float low = 0, high = 0, across = 0;
    for (const glm::vec3& p : points) {
      const float along = glm::dot(p - centre, axis);
      low = std::min(low, along);
      high = std::max(high, along);
      across += glm::length(p - centre - along * axis) / float(points.size());
    }
    if (across < kThinnest_m) continue;
    const int count = std::max(1, int(std::lround((high - low) / (2 * across))));
    for (int i = 0; i < count; ++i)
      spheres.push_back(
          {bone, centre + axis * (low + (float(i) + 0.5f) * (high - low) / float(count)), across});
  }
  return spheres;
}

}  // namespace crowd
