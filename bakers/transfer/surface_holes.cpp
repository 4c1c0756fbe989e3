#include "bakers/transfer/surface_holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nook::bake::transfer {
namespace {

// Corners of a triangle with their weights at a hit.
struct Corners {
  std::array<std::uint32_t, 3> vertex;
  std::array<float, 3> weight;
};
Corners corners_of(const SurfaceMesh& mesh, const RayHit& hit) {
  return {mesh.triangle[hit.triangle], {1 - hit.u - hit.v, hit.u, hit.v}};
}

// The texture coordinates' area over that of the triangle in space, per square metre.
float density(const SurfaceMesh& mesh, const std::array<std::uint32_t, 3>& vertex) {
  const Vec3 a = mesh.position[vertex[1]] - mesh.position[vertex[0]],
             b = mesh.position[vertex[2]] - mesh.position[vertex[0]];
  const TexturePoint o = mesh.uv[vertex[0]], p = mesh.uv[vertex[1]], q = mesh.uv[vertex[2]];
  const float area = std::abs((p.u - o.u) * (q.v - o.v) - (q.u - o.u) * (p.v - o.v));
  return area / std::max(length(cross(a, b)), 1e-20f);
}

}  // namespace

nook::transfer::Frame frame_at(const SurfaceMesh& mesh, const RayHit& hit) {
  const Corners at = corners_of(mesh, hit);
  Vec3 normal, tangent;
  for (std::size_t k = 0; k < 3; ++k) {
    normal += mesh.normal[at.vertex[k]] * at.weight[k];
    tangent += mesh.tangent[at.vertex[k]].direction * at.weight[k];
  }
  return nook::transfer::orthonormal_frame(normal, tangent, mesh.tangent[at.vertex[0]].handedness);
}

std::optional<SurfaceHoles> surface_holes(const SurfaceMesh& mesh, const HoleTable* table, float tiles,
                                          std::size_t rays) {
  if (!table) return {};
  // The side of a mean cell.
  const float spread_rad = std::sqrt(4 * std::numbers::pi_v<float> / float(rays));
  return SurfaceHoles(mesh, *table, tiles, spread_rad);
}

SurfaceHoles::SurfaceHoles(const SurfaceMesh& mesh, const HoleTable& table, float tiles, float spread_rad)
    : mesh_(mesh), table_(table), tiles_(tiles), spread_rad_(spread_rad) {}

float SurfaceHoles::cover(const RayHit& hit, Vec3 direction) const {
  const Corners at = corners_of(mesh_, hit);
  const nook::transfer::Frame frame = frame_at(mesh_, hit);
  Vec3 view{-dot(frame.tangent, direction), -dot(frame.bitangent(), direction),
            -dot(frame.normal, direction)};
  if (view.z < 0) view = -view;
  float u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    u += mesh_.uv[at.vertex[k]].u * at.weight[k];
    v += mesh_.uv[at.vertex[k]].v * at.weight[k];
  }
  const float footprint = hit.distance * spread_rad_;
  const float texels = density(mesh_, at.vertex) * tiles_ * tiles_ * float(table_.width * table_.height) *
                       footprint * footprint / std::max(view.z, 0.05f);
  return table_.cover_at(u * tiles_, v * tiles_, 0.5f * std::log2(std::max(texels, 1e-10f)), view);
}

float SurfaceHoles::share_through(const RayScene& scene, Vec3 origin, Vec3 direction) const {
  return walk_surfaces(scene, this, origin, direction, [](const RayHit&, float) {});
}

}  // namespace nook::bake::transfer
