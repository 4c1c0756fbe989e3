// Ray-traced ambient occlusion of a scene.
#include <nook/nook_bake_trace.h>

#include <limits>

#include "bakers/api/entry.h"
#include "bakers/job/pose_arrays.h"
#include "bakers/job/trace_arrays.h"
#include "bakers/job/worker_arena.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr std::size_t first_trace_desc = offsetof(nook_bake_trace_desc, origin_offset) + sizeof(float);

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
    need_count("count", count, d.point_count);
    if (d.mesh_count) need(d.meshes, "desc.meshes");
    need_trace_settings(d.rays, d.threads, d.origin_offset);
    if (!(d.radius > 0))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.radius is out of range (got %g, need metres above 0)",
                    double(d.radius));
    if (d.point_count == 0) return;
    need(d.positions, "desc.positions");
    need(d.normals, "desc.normals");
    TriangleSoup soup;
    for (std::uint32_t m = 0; m < d.mesh_count; ++m) add_mesh(d.meshes[m], m, soup);
    const std::vector<Vec3> position = read_points("desc.positions", d.positions, d.point_count);
    const std::vector<Vec3> normal = read_normals("desc.normals", d.normals, d.point_count);
    std::vector<float> result(d.point_count, 1.0f);
    if (!soup.triangle.empty())
      run_with_threads(d.threads, [&] {
        result = trace_ao(soup, {position, normal}, {d.rays, d.seed, d.radius, d.origin_offset});
      });
    std::copy(result.begin(), result.end(), ao);
  });
}
