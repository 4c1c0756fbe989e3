// Ray-traced ambient occlusion of a scene.
#include <nook/nook_bake.h>

#include <cmath>
#include <limits>

#include "api/entry.h"
#include "api/pose_arrays.h"
#include "api/worker_arena.h"
#include "core/descriptors.h"
#include "raytrace/ambient_occlusion.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_trace_desc = offsetof(nook_bake_trace_desc, origin_offset) + sizeof(float);
constexpr std::uint32_t most_rays = 65536, most_threads = 1024;

nook_bake_trace_desc default_trace_desc() {
  nook_bake_trace_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  desc.rays = 64;
  desc.seed = 1;
  desc.radius = std::numeric_limits<float>::infinity();
  desc.origin_offset = 1e-4f;
  return desc;
}

bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

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
    if (!is_finite(soup.position.back()))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.meshes[%u] has a position that is not finite (vertex %u)", number, v);
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
    if (!is_finite(points[i]))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is not finite at point %u", name, i);
  }
  return points;
}

}  // namespace

nook_result nook_bake_trace_desc_init(nook_bake_trace_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_bake_trace_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_trace_desc, default_trace_desc());
  });
}

nook_result nook_bake_trace_ao(const nook_bake_trace_desc* desc, float* ao, uint32_t count) {
  return api::enter("nook_bake_trace_ao", [&] {
    const nook_bake_trace_desc d =
        read_descriptor(desc, "nook_bake_trace_desc_init", first_trace_desc, default_trace_desc());
    need(ao, "ao");
    api::need_count("count", count, d.point_count);
    if (d.mesh_count) need(d.meshes, "desc.meshes");
    if (d.rays < 1 || d.rays > most_rays)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.rays is out of range (got %u, need 1 to %u)", d.rays,
                    most_rays);
    if (d.threads > most_threads)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.threads is out of range (got %u, need at most %u)",
                    d.threads, most_threads);
    if (!(d.radius > 0))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.radius is out of range (got %g, need metres above 0)",
                    double(d.radius));
    if (!(d.origin_offset >= 0) || !std::isfinite(d.origin_offset))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.origin_offset is out of range (got %g, need metres, 0 or above)",
                    double(d.origin_offset));
    if (d.point_count == 0) return;
    need(d.positions, "desc.positions");
    need(d.normals, "desc.normals");
    TriangleSoup soup;
    for (std::uint32_t m = 0; m < d.mesh_count; ++m) add_mesh(d.meshes[m], m, soup);
    const std::vector<Vec3> position = read_points("desc.positions", d.positions, d.point_count);
    const std::vector<Vec3> normal = read_points("desc.normals", d.normals, d.point_count);
    for (std::uint32_t i = 0; i < d.point_count; ++i)
      if (std::abs(length(normal[i]) - 1) > 1e-3f)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.normals is not of unit length at point %u (got %g); normalise it", i,
                      double(length(normal[i])));
    std::vector<float> result(d.point_count, 1.0f);
    if (!soup.triangle.empty())
      run_with_threads(d.threads, [&] {
        result = trace_ao(soup, {position, normal}, {d.rays, d.seed, d.radius, d.origin_offset});
      });
    std::copy(result.begin(), result.end(), ao);
  });
}
