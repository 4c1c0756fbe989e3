// Ray-traced ambient occlusion of a scene.
#include <nook/experimental/nook_trace.h>

#include <limits>

#include "bakers/api/descriptor_list.h"
#include "bakers/api/entry.h"
#include "bakers/job/pose_arrays.h"
#include "bakers/job/trace_arrays.h"
#include "bakers/job/worker_arena.h"
#include "bakers/raytrace/ambient_occlusion.h"

using namespace nook;
using namespace nook::bake;

namespace {}  // namespace

nook_result nook_bake_trace_ao(const nook_bake_trace_desc* desc, float* ao, uint32_t count) {
  return api::enter("nook_bake_trace_ao", [&] {
    const nook_bake_trace_desc d = read_descriptor(desc);
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
