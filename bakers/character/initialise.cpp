#include "bakers/character/initialise.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace nook::bake {
namespace {

// The vertices of a bone may lie in a plane or on a line. A sphere with the thickness as its radius would
// then cast no shadow. So the radius is at least these shares of the breadth and the length. The shares are
// too small to change the spheres of limbs, ears and fingers.
float least_radius(const float (&spread)[3]) {
  return std::max({0.05f * spread[1], 0.02f * spread[2], 1e-4f});
}

struct BoneShape {
  double area = 0;
  Vec3 mean;
  Vec3 axis;          // direction of the largest spread, unit length
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
  // The longer a bone is relative to its thickness, the more spheres it should get. The number is limited,
  // because a flat bone (least spread near 0) would otherwise get very many small spheres.
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
    // The rounding error carries over to the next bone, so that the total is exact.
    carried += total > double(order.size()) ? extra * (wish[i] - 1) / (total - double(order.size())) : 0;
    const auto more = std::size_t(std::floor(carried + 1e-9));
    carried -= double(more);
    const std::size_t count = 1 + more;
    const float radius = std::max(s.spread[0], least_radius(s.spread));
    // A uniform density over a length l has a standard deviation of l / sqrt(12).
    const float half = 0.5f * std::sqrt(12.0f) * s.spread[2] * (1 - 1 / float(count + 1));
    for (std::size_t j = 0; j < count; ++j) {
      const float at = count == 1 ? 0 : half * (2 * float(j) / float(count - 1) - 1);
      spheres.push_back({s.mean + at * s.axis, radius, std::uint16_t(order[i])});
    }
  }
  return spheres;
}

std::vector<KeyPoint> key_points_of_clusters(const SkinnedMesh& mesh, std::span<const std::uint32_t> cluster,
                                             std::span<const float> vertex_weight,
                                             std::span<const Vec3> normal) {
  const std::size_t count = cluster.empty() ? 0 : *std::max_element(cluster.begin(), cluster.end()) + 1;
  std::vector<float> size(count, 0.0f);
  std::vector<KeyPoint> points(count);
  std::vector<std::map<std::uint16_t, float>> weights(count);
  std::vector<Vec3> any_normal(count);
  for (std::size_t i = 0; i < cluster.size(); ++i) {
    const std::size_t c = cluster[i];
    const float w = std::max(vertex_weight[i], 1e-6f);
    size[c] += w;
    points[c].position += w * mesh.position[i];
    points[c].normal += w * normal[i];
    any_normal[c] = normal[i];
    for (int s = 0; s < SkinWeights::max_bones; ++s)
      if (mesh.weights[i].weight[s] > 0) weights[c][mesh.weights[i].bone[s]] += w * mesh.weights[i].weight[s];
  }
  for (std::size_t c = 0; c < count; ++c) {
    KeyPoint& p = points[c];
    p.position = p.position * (1 / size[c]);
    p.normal = normalised(p.normal);
    if (dot(p.normal, p.normal) == 0) p.normal = any_normal[c];
    p.surface_position = p.position;
    p.surface_normal = p.normal;
    std::vector<std::pair<float, std::uint16_t>> largest;
    for (const auto& [bone, w] : weights[c]) largest.push_back({w, bone});
    std::sort(largest.begin(), largest.end(), [](const auto& a, const auto& b) {
      return a.first != b.first ? a.first > b.first : a.second < b.second;
    });
    if (largest.size() > KeyPoint::max_bones) largest.resize(KeyPoint::max_bones);
    float total = 0;
    for (const auto& [w, bone] : largest) total += w;
    for (std::size_t j = 0; j < largest.size(); ++j) {
      p.weight[j] = largest[j].first / total;
      p.bone[j] = largest[j].second;
    }
  }
  return points;
}

FitState initial_state(const Kernel& kernel, std::span<const InitialSphere> spheres,
                       std::span<const KeyPoint> key_points) {
  FitState state;
  state.structure.kernel = kernel;
  for (const InitialSphere& s : spheres) state.structure.sphere_bone.push_back(s.bone);
  for (const KeyPoint& k : key_points) state.structure.key_point_bone.push_back(k.bone);
  state.parameters.resize(state.structure.parameter_count());
  for (std::size_t h = 0; h < spheres.size(); ++h) {
    float* q = &state.parameters[state.structure.sphere_offset(h)];
    q[0] = spheres[h].centre.x;
    q[1] = spheres[h].centre.y;
    q[2] = spheres[h].centre.z;
    q[3] = std::log(spheres[h].radius);
  }
  for (std::size_t k = 0; k < key_points.size(); ++k) {
    float* q = &state.parameters[state.structure.key_point_offset(k)];
    const KeyPoint& p = key_points[k];
    const float values[6] = {p.position.x, p.position.y, p.position.z, p.normal.x, p.normal.y, p.normal.z};
    std::copy_n(values, 6, q);
    for (int j = 0; j < KeyPoint::max_bones; ++j) q[6 + j] = std::sqrt(p.weight[j]);
    state.parameters[state.structure.saturation_offset(k)] = std::sqrt(p.saturation);
  }
  return state;
}

std::vector<float> placement_weights(std::span<const float> vertex_weight, const AoTargets& targets,
                                     std::size_t poses) {
  constexpr double least_share = 0.05;  // share of the mean variance; gives all parts of a body key points
  const std::size_t vertices = vertex_weight.size();
  std::vector<double> sum(vertices, 0.0), squares(vertices, 0.0);
  for (std::size_t t = 0; t < poses; ++t) {
    const auto row = targets.row(t);
    for (std::size_t i = 0; i < vertices; ++i) {
      const double ao = double(row[i]) * double(AoTargets::scale);
      sum[i] += ao;
      squares[i] += ao * ao;
    }
  }
  double mean = 0;
  for (std::size_t i = 0; i < vertices; ++i) {
    squares[i] = std::max(squares[i] - sum[i] * sum[i] / double(poses), 0.0);
    mean += squares[i] / double(vertices);
  }
  std::vector<float> weight(vertex_weight.begin(), vertex_weight.end());
  if (mean <= 0) return weight;
  for (std::size_t i = 0; i < vertices; ++i) weight[i] *= float(least_share + squares[i] / mean);
  return weight;
}

NearKeyPoints nearest_key_points(const SkinnedMesh& mesh, std::span<const Vec3> normal,
                                 std::span<const KeyPoint> key_points, std::size_t count) {
  count = std::min(count, key_points.size());
  NearKeyPoints nearest{std::vector<std::uint16_t>(mesh.vertex_count() * count),
                        std::vector<float>(mesh.vertex_count() * count)};
  // A normal that differs by 90 degrees counts like `normal_metres` of distance, and weights without a common
  // bone count like `weight_metres`. The values are for a body about 1.7 m tall.
  constexpr float normal_metres = 0.04f, weight_metres = 0.15f;
  constexpr std::size_t block = 256;
  tbb::parallel_for(std::size_t(0), (mesh.vertex_count() + block - 1) / block, [&](std::size_t b) {
    std::vector<std::pair<float, std::uint16_t>> distance(key_points.size());
    std::vector<float> dense(mesh.bones.size(), 0.0f);
    for (std::size_t i = b * block; i < std::min(mesh.vertex_count(), (b + 1) * block); ++i) {
      const SkinWeights& own = mesh.weights[i];
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] += own.weight[s];
      for (std::size_t k = 0; k < key_points.size(); ++k) {
        const KeyPoint& p = key_points[k];
        const Vec3 d = mesh.position[i] - p.position, n = normal[i] - p.normal;
        float shared = 0;
        for (int j = 0; j < KeyPoint::max_bones; ++j) shared += std::min(p.weight[j], dense[p.bone[j]]);
        const float unlike = 1 - std::min(1.0f, shared);
        distance[k] = {dot(d, d) + normal_metres * normal_metres * 0.5f * dot(n, n) +
                           weight_metres * weight_metres * unlike * unlike,
                       std::uint16_t(k)};
      }
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] = 0;
      std::partial_sort(distance.begin(), distance.begin() + std::ptrdiff_t(count), distance.end());
      // The nearness is 0.5 at the distance of the third nearest key point, so that weights change smoothly
      // between clusters.
      const float reach2 = std::max(distance[std::min<std::size_t>(2, count - 1)].first, 1e-8f);
      for (std::size_t c = 0; c < count; ++c) {
        nearest.key_point[i * count + c] = distance[c].second;
        nearest.nearness[i * count + c] = 1 / (1 + distance[c].first / reach2 + 1e-6f);
      }
    }
  });
  return nearest;
}

std::vector<Vec3> centre_of_rotation_normals(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                             std::span<const Vec3> mesh_normal) {
  const std::size_t vertices = mesh.vertex_count();
  std::vector<float> squared(vertices);
  for (std::size_t i = 0; i < vertices; ++i)
    for (float w : mesh.weights[i].weight) squared[i] += w * w;
  // The Gaussian depends on the distance between weight vectors, which is at most sqrt(2). This is the
  // inverse of its squared width.
  constexpr float inverse_width2 = 1 / 0.1f;
  std::vector<Vec3> normal(vertices);
  constexpr std::size_t block = 64;
  tbb::parallel_for(std::size_t(0), (vertices + block - 1) / block, [&](std::size_t b) {
    std::vector<float> dense(mesh.bones.size(), 0.0f);
    for (std::size_t i = b * block; i < std::min(vertices, (b + 1) * block); ++i) {
      const SkinWeights& own = mesh.weights[i];
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] += own.weight[s];
      Vec3 sum;
      float total = 0;
      for (std::size_t j = 0; j < vertices; ++j) {
        float shared = 0;
        for (int s = 0; s < SkinWeights::max_bones && mesh.weights[j].weight[s] > 0; ++s)
          shared += dense[mesh.weights[j].bone[s]] * mesh.weights[j].weight[s];
        if (shared == 0) continue;  // without a common bone the Gaussian is negligible
        const float distance2 = std::max(0.0f, squared[i] + squared[j] - 2 * shared);
        const float similarity = vertex_area[j] * std::exp(-distance2 * inverse_width2);
        sum += similarity * mesh.position[j];
        total += similarity;
      }
      for (int s = 0; s < SkinWeights::max_bones; ++s) dense[own.bone[s]] = 0;
      const Vec3 n = total > 0 ? normalised(mesh.position[i] - sum * (1 / total)) : Vec3{};
      normal[i] = dot(n, n) > 0 ? n : mesh_normal[i];
    }
  });
  return normal;
}

}  // namespace nook::bake
