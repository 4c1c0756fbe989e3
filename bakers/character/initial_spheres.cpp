#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/character/initialise.h"

namespace nook::bake {
namespace {

// A flat bone's spheres stand for patches of a surface, and those of a bone whose vertices lie on a line for
// stretches of it: as small as its thickness they would cast no shadow at all. These shares of its breadth
// and length are thinner than any limb, ear or finger.
float least_radius(const float (&spread)[3]) {
  return std::max({0.05f * spread[1], 0.02f * spread[2], 1e-4f});
}

struct BoneShape {
  double area = 0;
  Vec3 mean;
  Vec3 axis;          // of the largest spread, unit length
  float spread[3]{};  // standard deviations, ascending, metres
};

Eigen::Vector3d to_eigen(Vec3 v) {
  return {double(v.x), double(v.y), double(v.z)};
}
Vec3 from_eigen(const Eigen::Vector3d& v) {
  return {float(v.x()), float(v.y()), float(v.z())};
}

std::vector<BoneShape> bone_shapes(const SkinnedMesh& mesh, std::span<const float> vertex_area) {
  const std::size_t bones = mesh.bones.size();
  std::vector<double> area(bones, 0.0);
  std::vector<Eigen::Vector3d> sum(bones, Eigen::Vector3d::Zero());
  std::vector<Eigen::Matrix3d> second(bones, Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Eigen::Vector3d p = to_eigen(mesh.position[i]);
    for (int s = 0; s < SkinWeights::max_bones; ++s) {
      const double w = double(mesh.weights[i].weight[s]) * double(vertex_area[i]);
      if (w <= 0) continue;
      const std::size_t b = mesh.weights[i].bone[s];
      area[b] += w;
      sum[b] += w * p;
      second[b] += w * p * p.transpose();
    }
  }
  std::vector<BoneShape> shapes(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    if (area[b] <= 0) continue;
    const Eigen::Vector3d mean = sum[b] / area[b];
    const Eigen::Matrix3d covariance = second[b] / area[b] - mean * mean.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    shapes[b].area = area[b];
    shapes[b].mean = from_eigen(mean);
    shapes[b].axis = from_eigen(solver.eigenvectors().col(2));
    for (int i = 0; i < 3; ++i)
      shapes[b].spread[i] = float(std::sqrt(std::max(0.0, solver.eigenvalues()[i])));
  }
  return shapes;
}

}  // namespace

std::vector<InitialSphere> initial_spheres(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                           std::size_t sphere_count) {
  const std::vector<BoneShape> shapes = bone_shapes(mesh, vertex_area);
  std::vector<std::size_t> order;
  for (std::size_t b = 0; b < shapes.size(); ++b)
    if (shapes[b].area > 0) order.push_back(b);
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return shapes[a].area != shapes[b].area ? shapes[a].area > shapes[b].area : a < b;
  });
  if (order.size() > sphere_count) order.resize(sphere_count);
  // Elongation decides how many; a flat bone (l1 near 0) would ask for endless small ones, hence the cap.
  std::vector<double> wish(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BoneShape& s = shapes[order[i]];
    wish[i] = std::clamp(double(s.spread[2]) / std::max(double(s.spread[0]), 1e-6), 1.0, 8.0);
  }
  const double total = std::accumulate(wish.begin(), wish.end(), 0.0);
  const double extra = double(sphere_count - order.size());
  std::vector<InitialSphere> spheres;
  double carried = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const BoneShape& s = shapes[order[i]];
    // Rounding is carried to the next bone, so that the sum comes out right.
    carried += total > double(order.size()) ? extra * (wish[i] - 1) / (total - double(order.size())) : 0;
    const auto more = std::size_t(std::floor(carried + 1e-9));
    carried -= double(more);
    const std::size_t count = 1 + more;
    const float radius = std::max(s.spread[0], least_radius(s.spread));
    // Uniform density over a length l has standard deviation l / sqrt(12).
    const float half = 0.5f * std::sqrt(12.0f) * s.spread[2] * (1 - 1 / float(count + 1));
    for (std::size_t j = 0; j < count; ++j) {
      const float at = count == 1 ? 0 : half * (2 * float(j) / float(count - 1) - 1);
      spheres.push_back({s.mean + at * s.axis, radius, std::uint16_t(order[i])});
    }
  }
  return spheres;
}

}  // namespace nook::bake
