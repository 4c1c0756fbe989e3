#include "bakers/measure/character/surface_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "bakers/import/posed_normals.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/random.h"

namespace nook::measure {
namespace {

using namespace bake;

constexpr std::size_t most_poses = 24, point_count = 2048;
constexpr std::uint32_t rays = 256;

// Triangles are drawn with a probability proportional to their area. Points are uniform on a triangle.
std::vector<SurfacePoint> spread_points(const SkinnedMesh& mesh, Random& random) {
  std::vector<double> sums;
  double sum = 0;
  for (const auto& t : mesh.triangle) {
    const Vec3 a = mesh.position[t[0]], b = mesh.position[t[1]], c = mesh.position[t[2]];
    sums.push_back(sum += double(length(cross(b - a, c - a))));
  }
  std::vector<SurfacePoint> points(point_count);
  for (SurfacePoint& point : points) {
    const auto at = std::upper_bound(sums.begin(), sums.end(), random.unit_double() * sum);
    const std::size_t triangle = std::min(std::size_t(at - sums.begin()), sums.size() - 1);
    const float root = std::sqrt(random.unit()), along = random.unit();
    point = {mesh.triangle[triangle], {1 - root, root * (1 - along), root * along}};
  }
  return points;
}

template <class Value>
Value interpolated(const SurfacePoint& point, std::span<const Value> values) {
  Value sum{};
  for (std::size_t i = 0; i < 3; ++i) sum += point.weight[i] * values[point.vertex[i]];
  return sum;
}

std::vector<float> traced_points(const SkinnedMesh& mesh, const Pose& pose,
                                 std::span<const SurfacePoint> points, std::uint64_t seed,
                                 const Progress& progress) {
  std::vector<Vec3> position, normal, point_position, point_normal;
  skin_positions(mesh, pose, position);
  posed_normals(mesh, pose, position, normal);
  for (const SurfacePoint& point : points) {
    point_position.push_back(interpolated<Vec3>(point, position));
    const Vec3 mean = interpolated<Vec3>(point, normal);
    // Normals that cancel out have no direction. In this case, uses the normal of a vertex.
    point_normal.push_back(length(mean) > 0 ? normalised(mean) : normal[point.vertex[0]]);
  }
  AoSettings settings;
  settings.rays = rays;
  settings.seed = seed;
  settings.origin_offset = ray_origin_offset(mesh.position);
  return trace_ao(TriangleSoup{position, mesh.triangle}, {point_position, point_normal}, settings, progress);
}

}  // namespace

SurfaceErrors measure_surface(const SkinnedMesh& mesh, const CharacterModel& model,
                              std::span<const Pose> poses, std::uint64_t seed, const Progress& progress) {
  std::vector<Pose> sample;
  const std::size_t count = std::min(most_poses, poses.size());
  for (std::size_t i = 0; i < count; ++i) sample.push_back(poses[i * poses.size() / count]);
  Random random(seed);
  const std::vector<SurfacePoint> points = spread_points(mesh, random);
  // Tracing the vertices takes nearly all of the time.
  const AoTargets vertices = trace_character_ao(mesh, sample, rays, mix_bits(seed), progress);
  const Progress goes_on = [&](std::size_t, std::size_t) { return !progress || progress(count, count); };

  SurfaceErrors errors;
  double visible = 0;
  for (std::size_t p = 0; p < count; ++p) {
    const std::vector<float> truth = traced_points(mesh, sample[p], points, mix_bits(seed + p), goes_on);
    const std::vector<float> predicted = predict_ao(model, sample[p]);
    std::vector<float> exact;
    for (const std::uint16_t v : vertices.row(p)) exact.push_back(float(v) * AoTargets::scale);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (double(truth[i]) < visible_truth) continue;
      const auto square = [&](std::span<const float> values) {
        const double error = double(interpolated(points[i], values)) - double(truth[i]);
        return error * error;
      };
      visible += 1;
      errors.model += square(predicted);
      errors.exact_vertices += square(exact);
      if (!model.static_ao.empty()) errors.static_bake += square(model.static_ao);
    }
  }
  if (!(visible > 0)) return errors;
  for (double* sum : {&errors.model, &errors.static_bake, &errors.exact_vertices}) *sum /= visible;
  errors.visible_share = visible / double(count * points.size());
  return errors;
}

}  // namespace nook::measure
