#include "bakers/job/trace_arrays.h"

#include <cmath>

#include "bakers/job/worker_arena.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::bake {
namespace {

constexpr std::uint32_t most_rays = 65536;

}  // namespace

void add_mesh(const nook_bake_occluder_mesh& mesh, std::uint32_t number, TriangleSoup& soup) {
  if (mesh.index_count == 0) return;
  need(mesh.positions, "desc.meshes[i].positions");
  need(mesh.indices, "desc.meshes[i].indices");
  if (mesh.index_count % 3)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.meshes[%u].index_count is not a multiple of 3 (got %u)",
                  number, mesh.index_count);
  const auto base = std::uint32_t(soup.position.size());
  for (std::uint32_t v = 0; v < mesh.vertex_count; ++v) {
    soup.position.push_back({mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.positions[3 * v + 2]});
    const Vec3 p = soup.position.back();
    if (!is_place(p))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.meshes[%u] has vertex %u out of range (got %g %g %g, need finite metres up to 1e6)",
                    number, v, double(p.x), double(p.y), double(p.z));
  }
  for (std::uint32_t i = 0; i < mesh.index_count; i += 3) {
    for (std::uint32_t c = 0; c < 3; ++c)
      if (mesh.indices[i + c] >= mesh.vertex_count)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.meshes[%u] has an index out of range (got %u, there are %u vertices)", number,
                      mesh.indices[i + c], mesh.vertex_count);
    soup.triangle.push_back({base + mesh.indices[i], base + mesh.indices[i + 1], base + mesh.indices[i + 2]});
  }
}

std::vector<Vec3> read_points(const char* name, const float* xyz, std::uint32_t count) {
  std::vector<Vec3> points(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    points[i] = {xyz[3 * std::size_t(i)], xyz[3 * std::size_t(i) + 1], xyz[3 * std::size_t(i) + 2]};
    if (!is_place(points[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s is out of range at point %u (got %g %g %g, need finite numbers up to 1e6)", name, i,
                    double(points[i].x), double(points[i].y), double(points[i].z));
  }
  return points;
}

std::vector<Vec3> read_normals(const char* name, const float* xyz, std::uint32_t count) {
  std::vector<Vec3> normals = read_points(name, xyz, count);
  for (std::uint32_t i = 0; i < count; ++i)
    if (std::abs(length(normals[i]) - 1) > 1e-3f)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "%s is not of unit length at point %u (got %g); normalise it", name, i,
                    double(length(normals[i])));
  return normals;
}

void need_trace_settings(std::uint32_t rays, std::uint32_t threads, float origin_offset) {
  if (rays < 1 || rays > most_rays)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.rays is out of range (got %u, need 1 to %u)", rays,
                  most_rays);
  need_threads(threads);
  if (!(origin_offset >= 0 && origin_offset <= max_metres))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.origin_offset is out of range (got %g, need 0 to 1e6 metres)", double(origin_offset));
}

}  // namespace nook::bake
