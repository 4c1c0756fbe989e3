#include "bakers/world/initial_casters.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace nook::bake {
namespace {

// Maximum number of vertices. Larger meshes keep some longer edges.
constexpr std::size_t most_vertices = 40000;

float diagonal_of(const std::vector<Vec3>& position) {
  if (position.empty()) return 0;
  Vec3 low = position[0], high = position[0];
  for (const Vec3 p : position) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  return length(high - low);
}

}  // namespace

SkinnedMesh refined(const SkinnedMesh& mesh) {
  SkinnedMesh out;
  out.bones = mesh.bones;
  out.position = mesh.position;
  out.weights = mesh.weights;
  const float longest = diagonal_of(mesh.position) / 40;
  std::vector<std::array<std::uint32_t, 3>> left = mesh.triangle;
  while (!left.empty()) {
    const std::array<std::uint32_t, 3> t = left.back();
    left.pop_back();
    std::size_t edge = 0;
    float size = -1;
    for (std::size_t i = 0; i < 3; ++i) {
      const float own = length(out.position[t[(i + 1) % 3]] - out.position[t[i]]);
      if (own > size) {
        size = own;
        edge = i;
      }
    }
    // Also true if a position is not finite.
    if (!(size > longest) || out.position.size() >= most_vertices) {
      out.triangle.push_back(t);
      continue;
    }
    const std::uint32_t a = t[edge], b = t[(edge + 1) % 3], c = t[(edge + 2) % 3];
    const auto middle = static_cast<std::uint32_t>(out.position.size());
    out.position.push_back(0.5f * (out.position[a] + out.position[b]));
    out.weights.push_back(out.weights[a]);
    left.push_back({a, middle, c});
    left.push_back({middle, b, c});
  }
  return out;
}

namespace {

// The vertices that one capsule represents.
struct Part {
  std::uint16_t bone = 0;
  std::vector<std::uint32_t> vertex;
  double area = 0;
};

struct Shape {
  Vec3 mean;
  Vec3 axis[3];       // ascending by spread, unit length
  float spread[3]{};  // standard deviations, metres
};

Shape shape_of(const Part& part, std::span<const Vec3> position, std::span<const float> area) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  double total = 0;
  for (const std::uint32_t v : part.vertex) {
    const double w = double(area[v]) + 1e-12;
    const Eigen::Vector3d p(double(position[v].x), double(position[v].y), double(position[v].z));
    total += w;
    sum += w * p;
    second += w * p * p.transpose();
  }
  const Eigen::Vector3d mean = sum / total;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
      Eigen::Matrix3d(second / total - mean * mean.transpose()));
  Shape shape;
  const auto from_eigen = [](const Eigen::Vector3d& v) {
    return Vec3{float(v.x()), float(v.y()), float(v.z())};
  };
  shape.mean = from_eigen(mean);
  for (int i = 0; i < 3; ++i) {
    shape.axis[i] = from_eigen(solver.eigenvectors().col(i));
    shape.spread[i] = float(std::sqrt(std::max(0.0, solver.eigenvalues()[i])));
  }
  return shape;
}

// A caster thinner than this has no visible effect.
constexpr float least_radius_m = 1e-3f;

WorldCaster capsule_of(const Part& part, std::span<const Vec3> position, std::span<const float> area) {
  const Shape shape = shape_of(part, position, area);
  const Vec3 axis = shape.axis[2];
  double total = 0, distance = 0;
  float low = INFINITY, high = -INFINITY;
  for (const std::uint32_t v : part.vertex) {
    const Vec3 d = position[v] - shape.mean;
    const float along = dot(d, axis);
    low = std::min(low, along);
    high = std::max(high, along);
    const double w = double(area[v]) + 1e-12;
    total += w;
    distance += w * double(length(d - along * axis));
  }
  const float radius = std::max(float(distance / total), least_radius_m);
  const float middle = 0.5f * (low + high), half = std::max(0.5f * (high - low) - radius, 0.0f);
  WorldCaster caster;
  caster.bone = part.bone;
  caster.capsule = {shape.mean + (middle - half) * axis, shape.mean + (middle + half) * axis, radius, radius};
  return caster;
}

std::vector<Part> parts_of_bones(const SkinnedMesh& mesh, std::span<const float> area) {
  std::vector<Part> parts(mesh.bones.size());
  for (std::size_t b = 0; b < parts.size(); ++b) parts[b].bone = std::uint16_t(b);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    Part& part = parts[mesh.weights[v].bone[0]];
    part.vertex.push_back(std::uint32_t(v));
    part.area += double(area[v]);
  }
  return parts;
}

bool by_area(const Part& a, const Part& b) {
  return a.area != b.area ? a.area < b.area : a.bone < b.bone;
}

// Low-poly bodies get fewer capsules. With more, capsules would follow single triangles and would cost as
// much as the capsules of a detailed body.
constexpr std::size_t least_vertices = 12;

void drop_empty(std::vector<Part>& parts) {
  std::erase_if(parts, [](const Part& part) { return part.vertex.empty(); });
}

// Bones with less than this share of the body's area, such as fingers, are merged with their parents.
constexpr double small_share = 0.004;

// Returns the nearest ancestor with a part. If there is none, returns the part with the largest area.
std::size_t host_of(const std::vector<Part>& parts, const SkinnedMesh& mesh, std::size_t small) {
  for (std::int32_t b = mesh.bones[parts[small].bone].parent; b >= 0; b = mesh.bones[std::size_t(b)].parent)
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (i != small && parts[i].bone == std::uint32_t(b)) return i;
  std::size_t largest = small == 0 ? 1 : 0;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (i != small && by_area(parts[largest], parts[i])) largest = i;
  return largest;
}

void join_small(std::vector<Part>& parts, const SkinnedMesh& mesh, std::size_t count) {
  double total = 0;
  for (const Part& part : parts) total += part.area;
  while (parts.size() > 1) {
    const auto least = std::min_element(parts.begin(), parts.end(), by_area);
    if (parts.size() <= count && least->area >= small_share * total) return;
    const auto small = std::size_t(least - parts.begin());
    Part& host = parts[host_of(parts, mesh, small)];
    host.vertex.insert(host.vertex.end(), parts[small].vertex.begin(), parts[small].vertex.end());
    host.area += parts[small].area;
    parts.erase(parts.begin() + std::ptrdiff_t(small));
  }
}

// Cuts at the mean, across the axis with the largest spread. Returns false if all vertices lie on one side.
bool cut(std::vector<Part>& parts, std::size_t which, std::span<const Vec3> position,
         std::span<const float> area) {
  const Shape shape = shape_of(parts[which], position, area);
  Part low, high;
  low.bone = high.bone = parts[which].bone;
  for (const std::uint32_t v : parts[which].vertex) {
    Part& side = dot(position[v] - shape.mean, shape.axis[2]) < 0 ? low : high;
    side.vertex.push_back(v);
    side.area += double(area[v]);
  }
  if (low.vertex.size() < 4 || high.vertex.size() < 4) return false;
  parts[which] = std::move(low);
  parts.push_back(std::move(high));
  return true;
}

// Returns how badly one capsule fits a part: (breadth - thickness) * area.
double misfit(const Part& part, std::span<const Vec3> position, std::span<const float> area) {
  const Shape shape = shape_of(part, position, area);
  return part.area * double(shape.spread[1] - 0.7f * shape.spread[0]) +
         0.15 * part.area * double(shape.spread[2]);
}

}  // namespace

std::vector<WorldCaster> bone_capsules(const SkinnedMesh& mesh, std::span<const float> vertex_area) {
  std::vector<Part> parts = parts_of_bones(mesh, vertex_area);
  drop_empty(parts);
  std::vector<WorldCaster> casters;
  for (const Part& part : parts) casters.push_back(capsule_of(part, mesh.position, vertex_area));
  return casters;
}

std::vector<WorldCaster> initial_casters(const SkinnedMesh& mesh, std::span<const float> vertex_area,
                                         std::size_t count) {
  std::vector<Part> parts = parts_of_bones(mesh, vertex_area);
  drop_empty(parts);
  join_small(parts, mesh, count);
  std::vector<double> badness;
  for (const Part& part : parts) badness.push_back(misfit(part, mesh.position, vertex_area));
  const std::size_t most = std::min(count, mesh.position.size() / least_vertices);
  while (parts.size() < most) {
    const auto worst = std::size_t(std::max_element(badness.begin(), badness.end()) - badness.begin());
    if (!(badness[worst] > 0)) break;
    if (!cut(parts, worst, mesh.position, vertex_area)) {
      badness[worst] = 0;
      continue;
    }
    badness[worst] = misfit(parts[worst], mesh.position, vertex_area);
    badness.push_back(misfit(parts.back(), mesh.position, vertex_area));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.bone < b.bone; });
  std::vector<WorldCaster> casters;
  for (const Part& part : parts) casters.push_back(capsule_of(part, mesh.position, vertex_area));
  return casters;
}

}  // namespace nook::bake
