#include "bakers/import/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace nook::bake {
namespace {

// Groups of equal vertices: group[v] is the smallest vertex whose numbers equal those of v; -0 equals 0.
std::vector<std::uint32_t> equal_vertices(const std::vector<std::array<float, 8>>& key) {
  std::vector<std::uint32_t> order(key.size()), group(key.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return key[a] < key[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)
    group[order[i]] = i > 0 && key[order[i]] == key[order[i - 1]] ? group[order[i - 1]] : order[i];
  return group;
}

double corner_angle(Vec3 normal, Vec3 to_next, Vec3 to_previous) {
  const Vec3 a = normalised(to_next - normal * dot(normal, to_next));
  const Vec3 b = normalised(to_previous - normal * dot(normal, to_previous));
  return std::acos(std::clamp(double(dot(a, b)), -1.0, 1.0));
}

// The direction of growing u in a triangle's plane and the sign of its area in texture coordinates; 0 if one
// of the areas is not above 0.
struct Slope {
  Vec3 along_u;
  int sign = 0;
};
Slope slope_of(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = mesh.position[t[1]] - mesh.position[t[0]], b = mesh.position[t[2]] - mesh.position[t[0]];
  const TexturePoint& at = mesh.uv[t[0]];
  const double u1 = double(mesh.uv[t[1]].u) - double(at.u), v1 = double(mesh.uv[t[1]].v) - double(at.v);
  const double u2 = double(mesh.uv[t[2]].u) - double(at.u), v2 = double(mesh.uv[t[2]].v) - double(at.v);
  const double area = u1 * v2 - u2 * v1;
  Slope slope;
  if (!(length(cross(a, b)) > 0) || !(std::abs(area) > 0)) return slope;
  const float sign = area > 0 ? 1.0f : -1.0f;
  // The scale does not matter, and the larger of the two factors becomes 1.
  const double most = std::max(std::abs(v1), std::abs(v2));
  slope.along_u = normalised((a * float(v2 / most) - b * float(v1 / most)) * sign);
  if (dot(slope.along_u, slope.along_u) > 0) slope.sign = int(sign);
  return slope;
}

struct Sums {
  Vec3 direction[2];  // of mirrored triangles, and of the others
};

void warn(std::vector<std::string>& warnings, std::size_t count, const char* text) {
  if (count > 0) warnings.push_back(std::to_string(count).append(text));
}

}  // namespace

Vec3 across_normal(Vec3 normal, Vec3 direction) {
  const Vec3 flat = direction - normal * dot(normal, direction);
  if (length(flat) > 1e-6f * std::max(length(direction), 1e-20f)) return normalised(flat);
  const Vec3 away = std::abs(normal.x) < 0.6f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  return normalised(away - normal * dot(normal, away));
}

std::vector<Vec3> smooth_normals(std::span<const Vec3> position,
                                 std::span<const std::array<std::uint32_t, 3>> triangle) {
  std::vector<std::array<float, 8>> key(position.size());
  for (std::size_t v = 0; v < key.size(); ++v)
    key[v] = {position[v].x + 0.0f, position[v].y + 0.0f, position[v].z + 0.0f};
  const std::vector<std::uint32_t> group = equal_vertices(key);
  std::vector<Vec3> normal(position.size());
  for (const auto& t : triangle) {
    const Vec3 area = cross(position[t[1]] - position[t[0]], position[t[2]] - position[t[0]]);
    for (const std::uint32_t v : t) normal[group[v]] += area;
  }
  for (std::size_t v = 0; v < normal.size(); ++v)
    if (group[v] == v) {
      normal[v] = normalised(normal[v]);
      if (dot(normal[v], normal[v]) == 0) normal[v] = {0, 0, 1};
    }
  for (std::size_t v = 0; v < normal.size(); ++v) normal[v] = normal[group[v]];
  return normal;
}

std::vector<Tangent> surface_tangents(const SurfaceMesh& mesh, std::vector<std::string>& warnings) {
  const std::size_t count = mesh.position.size();
  std::vector<std::array<float, 8>> key(count);
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 p = mesh.position[v], n = mesh.normal[v];
    key[v] = {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f,          n.x + 0.0f,
              n.y + 0.0f, n.z + 0.0f, mesh.uv[v].u + 0.0f, mesh.uv[v].v + 0.0f};
  }
  const std::vector<std::uint32_t> group = equal_vertices(key);
  std::vector<Sums> sums(count);                     // of groups
  std::vector<std::array<double, 2>> angles(count);  // of vertices: mirrored, others
  std::size_t degenerate = 0;
  for (const auto& t : mesh.triangle) {
    const Slope slope = slope_of(mesh, t);
    if (slope.sign == 0) {
      ++degenerate;
      continue;
    }
    const std::size_t side = slope.sign > 0 ? 1 : 0;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t v = t[std::size_t(c)];
      const Vec3 n = mesh.normal[v], p = mesh.position[v];
      const double angle = corner_angle(n, mesh.position[t[std::size_t(c + 1) % 3]] - p,
                                        mesh.position[t[std::size_t(c + 2) % 3]] - p);
      const Vec3 flat = slope.along_u - n * dot(n, slope.along_u);
      sums[group[v]].direction[side] += normalised(flat) * float(angle);
      angles[v][side] += angle;
    }
  }
  std::vector<Tangent> tangent(count);
  std::size_t shared = 0, without = 0;
  for (std::size_t v = 0; v < count; ++v) {
    const bool is_mirrored = angles[v][0] > angles[v][1];
    shared += angles[v][0] > 0 && angles[v][1] > 0;
    without += angles[v][0] + angles[v][1] == 0;
    tangent[v] = {across_normal(mesh.normal[v], sums[group[v]].direction[is_mirrored ? 0 : 1]),
                  is_mirrored ? -1.0f : 1.0f};
  }
  warn(warnings, degenerate,
       " triangles have no area, or none in their texture coordinates, and do not count for tangents");
  warn(warnings, shared,
       " vertices are shared by mirrored and other texture coordinates; split them for correct tangents");
  warn(warnings, without, " vertices have no triangle with an area, and got arbitrary tangents");
  return tangent;
}

}  // namespace nook::bake
