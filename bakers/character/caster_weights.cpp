#include "bakers/character/caster_weights.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bakers/import/posed_normals.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"
#include "sdk/src/character/kernel.h"
#include "sdk/src/character/model.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {
namespace {

struct Point {
  Vec3 position, normal;
};

// Maps two uniform numbers to a direction that is uniform over the sphere.
Vec3 sphere_direction(float u, float v) {
  const float z = 2 * u - 1, r = std::sqrt(std::max(0.0f, 1 - z * z)), a = 2 * std::numbers::pi_v<float> * v;
  return {r * std::cos(a), r * std::sin(a), z};
}

std::vector<Point> points_round(Vec3 centre, float radius, std::size_t count, std::uint64_t seed) {
  std::vector<Point> points(count);
  Random random(seed);
  for (Point& p : points) {
    // The logarithm of the distance is uniform, so that every scale has the same weight.
    const float distance = radius * 0.3f * std::pow(8 / 0.3f, random.unit());
    const float u = random.unit(), v = random.unit();
    p.position = centre + distance * sphere_direction(u, v);
    const float s = random.unit(), t = random.unit();
    p.normal = sphere_direction(s, t);
    // Flips normals that face away from the body, because points with such normals have little occlusion.
    if (dot(p.normal, centre - p.position) < 0) p.normal = -p.normal;
  }
  return points;
}

// Returns points in front of random vertices, 0.03 to 0.5 body radii away. Their normals face the surface.
std::vector<Point> points_near(std::span<const Vec3> position, std::span<const Vec3> normal, float radius,
                               std::size_t count, std::uint64_t seed) {
  std::vector<Point> points(count);
  Random random(seed);
  for (Point& p : points) {
    const std::uint32_t vertex = random.below(std::uint32_t(position.size()));
    p.position = position[vertex] + radius * random.log_between(0.03f, 0.5f) * normal[vertex];
    const float u = random.unit(), v = random.unit();
    p.normal = sphere_direction(u, v);
    if (dot(p.normal, normal[vertex]) > 0) p.normal = -p.normal;
  }
  return points;
}

std::vector<Point> fit_points(std::span<const Vec3> position, std::span<const Vec3> normal, Vec3 centre,
                              float radius, const CasterFitSettings& settings, std::uint64_t seed) {
  const std::size_t near = settings.points_per_pose / 10;
  std::vector<Point> points = points_round(centre, radius, settings.points_per_pose - near, seed);
  const std::vector<Point> others = points_near(position, normal, radius, near, ~seed);
  points.insert(points.end(), others.begin(), others.end());
  return points;
}

// Inverse of solid_depth: returns the sum over spheres that gives a solid depth of `depth`.
double sum_of_solid_depth(double depth) {
  constexpr double c = NOOK_SOLID_DEPTH;
  return (std::sqrt(1 + 4 * c * depth) - 1) / (2 * c);
}

}  // namespace

void fit_caster_weights(CharacterModel& model, const SkinnedMesh& mesh, std::span<const Pose> poses,
                        const CasterFitSettings& settings,
                        const std::function<bool(std::size_t, std::size_t)>& progress) {
  const std::size_t spheres = model.spheres.size(), used = std::min(settings.poses, poses.size());
  const auto n = Eigen::Index(spheres);
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  TriangleSoup body;
  body.triangle = mesh.triangle;
  double equations = 0;
  for (std::size_t s = 0; s < used; ++s) {
    if (progress && !progress(s, used))
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while fitting casters");
    const Pose& pose = poses[s * poses.size() / used];
    skin_positions(mesh, pose, body.position);
    const Vec3 centre = transform_point(pose[model.root_bone], model.bounding_centre);
    std::vector<Vec3> front;
    posed_normals(mesh, pose, body.position, front);
    const std::vector<Point> points =
        fit_points(body.position, front, centre, model.bounding_radius, settings, settings.seed + s);
    std::vector<Vec3> position, normal;
    for (const Point& p : points) {
      position.push_back(p.position);
      normal.push_back(p.normal);
    }
    const AoSettings rays{settings.rays, settings.seed + 977 * s};
    const std::vector<float> ao = trace_ao(body, {position, normal}, rays);
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::VectorXd row(n);
      for (std::size_t h = 0; h < spheres; ++h) {
        const ProxySphere& sphere = model.spheres[h];
        const float inverse_radius = 1 / sphere.radius;
        const Vec3 d =
            (transform_point(pose[sphere.bone], sphere.centre) - points[i].position) * inverse_radius;
        row[Eigen::Index(h)] = double(form_factor_fast(dot(d, points[i].normal), dot(d, d)));
      }
      // Skips points inside the body. They are fully occluded and tell nothing about the occlusion outside.
      const double occlusion = 1 - double(ao[i]);
      if (occlusion > 0.97) continue;
      const double depth = sum_of_solid_depth(-std::log1p(-occlusion));
      // The weight depends on the expected depth. If it depended on the noisy traced depth, the noise would
      // bias the fit.
      const double expected = std::max(row.sum() * 0.5, 1e-4);
      const double weight = 1 / ((expected + 0.003) * (expected + 0.003));
      gram += weight * row * row.transpose();
      right += weight * depth * row;
      ++equations;
    }
  }
  if (equations == 0) return;
  // The ridge pulls all weights slightly towards a common value. Without it, spheres with nearly the same
  // effect could get very different weights.
  const double common = std::max(0.0, right.sum() / std::max(gram.sum(), 1e-30));
  const double pull = 1e-3 * gram.trace() / double(spheres);
  gram.diagonal().array() += pull;
  right.array() += pull * common;
  Eigen::VectorXd weight = Eigen::VectorXd::Constant(n, common);
  for (int sweep = 0; sweep < 400; ++sweep)
    for (Eigen::Index h = 0; h < n; ++h)
      weight[h] = std::clamp(weight[h] + (right[h] - gram.row(h).dot(weight)) / gram(h, h), 0.0,
                             double(max_coefficient));
  for (std::size_t h = 0; h < spheres; ++h) model.spheres[h].caster_weight = float(weight[Eigen::Index(h)]);
}

}  // namespace nook::bake
