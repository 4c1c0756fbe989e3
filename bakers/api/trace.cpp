// Traces rays in a scene that the caller provides, for ambient occlusion and path-traced irradiance.
#include <nook/experimental/nook_trace.h>

#include <cmath>
#include <limits>

#include "bakers/api/bake_descriptors.h"
#include "bakers/api/bake_entry.h"
#include "bakers/job/bake_job.h"
#include "bakers/job/caller_arrays.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/path_tracer.h"
#include "bakers/raytrace/worker_arena.h"

using namespace nook;
using namespace nook::bake;

namespace {

// Returns an empty function if there is no callback.
Progress progress_of(nook_bake_progress_fn call, void* user) {
  const BakeJob::Listener listener = listener_of(call, user);
  if (!listener) return {};
  return [listener](std::size_t done, std::size_t total) {
    return listener({false, JobStage::raytrace, done, total});
  };
}

}  // namespace

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
        result = trace_ao(soup, {position, normal}, {d.rays, d.seed, d.radius, d.origin_offset},
                          progress_of(d.progress, d.progress_user));
      });
    std::copy(result.begin(), result.end(), ao);
  });
}

namespace {

constexpr std::uint32_t most_columns = 16384, most_rows = 8192;

Environment read_environment(const nook_bake_environment& map) {
  if (map.width == 0 && !map.rgb) return Environment(1, 1, {0, 0, 0});
  need(map.rgb, "desc.environment.rgb");
  if (map.width < 1 || map.width > most_columns || map.height < 1 || map.height > most_rows)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.environment has %u x %u texels (need 1 x 1 to %u x %u)",
                  map.width, map.height, most_columns, most_rows);
  const std::size_t size = 3 * std::size_t(map.width) * map.height;
  return Environment(map.width, map.height, {map.rgb, map.rgb + size});
}

Surface read_surface(const nook_bake_lit_mesh& mesh, std::uint32_t number) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(mesh.base_colour[i] >= 0 && mesh.base_colour[i] <= 1))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.meshes[%u].base_colour is out of range (got %g, need 0 to 1)", number,
                    double(mesh.base_colour[i]));
    if (!(mesh.emission[i] >= 0 && double(mesh.emission[i]) <= max_radiance))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.meshes[%u].emission is out of range (got %g, need 0 to %g)", number,
                    double(mesh.emission[i]), max_radiance);
  }
  return {{mesh.base_colour[0], mesh.base_colour[1], mesh.base_colour[2]},
          {mesh.emission[0], mesh.emission[1], mesh.emission[2]}};
}

LitTriangles read_lit_meshes(const nook_bake_lit_mesh* meshes, std::uint32_t count) {
  LitTriangles lit;
  for (std::uint32_t m = 0; m < count; ++m) {
    add_mesh({meshes[m].positions, meshes[m].indices, meshes[m].vertex_count, meshes[m].index_count}, m,
             lit.soup);
    lit.surface.push_back(read_surface(meshes[m], m));
    lit.triangle_surface.resize(lit.soup.triangle.size(), m);
  }
  return lit;
}

}  // namespace

nook_result nook_bake_trace_irradiance(const nook_bake_irradiance_desc* desc, float* irradiance,
                                       uint32_t count) {
  return api::enter("nook_bake_trace_irradiance", [&] {
    const nook_bake_irradiance_desc d = read_descriptor(desc);
    need(irradiance, "irradiance");
    need_count("count", count, d.point_count);
    if (d.mesh_count) need(d.meshes, "desc.meshes");
    need_trace_settings(d.rays, d.threads, d.origin_offset);
    if (d.point_count == 0) return;
    need(d.positions, "desc.positions");
    need(d.normals, "desc.normals");
    const std::vector<Vec3> position = read_points("desc.positions", d.positions, d.point_count);
    const std::vector<Vec3> normal = read_normals("desc.normals", d.normals, d.point_count);
    const LitScene scene(read_lit_meshes(d.meshes, d.mesh_count), read_environment(d.environment));
    std::vector<Vec3> result;
    run_with_threads(d.threads, [&] {
      result = trace_irradiance(scene, {position, normal}, {d.rays, d.seed, {d.max_bounces, d.origin_offset}},
                                progress_of(d.progress, d.progress_user));
    });
    for (std::size_t i = 0; i < result.size(); ++i) {
      irradiance[3 * i] = result[i].x;
      irradiance[3 * i + 1] = result[i].y;
      irradiance[3 * i + 2] = result[i].z;
    }
  });
}
