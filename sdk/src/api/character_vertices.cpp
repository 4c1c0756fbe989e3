#include <nook/experimental/nook_lod.h>
#include <nook/nook_character.h>

#include <cmath>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/host_vertices.h"
#include "sdk/src/core/checks.h"

using namespace nook;

namespace {

StridedPoints points_of(const float* first, std::size_t stride, std::uint32_t count, const char* name,
                        const char* stride_name) {
  const StridedPoints points{first, checked_stride(stride_name, stride, count, 3 * sizeof(float))};
  for (std::uint32_t i = 0; first && i < count; ++i) {
    const Vec3 p = points[i];
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s[%u] is not finite (got %g %g %g)", name, i,
                    double(p.x), double(p.y), double(p.z));
  }
  return points;
}

HostVertices host_vertices(const CharacterModel& model, const nook_vertex_match_desc& match) {
  need(match.positions, "desc.positions");
  if (model.rest.position.empty() || model.bind.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the model has no rest positions; bake it again");
  if (match.primitive < NOOK_ALL_PRIMITIVES ||
      (match.primitive >= 0 && static_cast<std::size_t>(match.primitive) >= model.primitives.size()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.primitive is out of range (got %d, need -1 to %zu)",
                  match.primitive, model.primitives.size() - 1);
  check_fits("desc.in_rest_space", match.in_rest_space, match.in_rest_space <= 1, "0 or 1");
  check_range("desc.tolerance", match.tolerance, 0, 1);
  HostVertices host;
  host.count = match.vertex_count;
  host.position = points_of(match.positions, match.position_stride, match.vertex_count, "positions",
                            "desc.position_stride");
  host.normal =
      points_of(match.normals, match.normal_stride, match.vertex_count, "normals", "desc.normal_stride");
  host.in_rest_space = match.in_rest_space != 0;
  host.primitive = match.primitive;
  if (match.tolerance > 0) host.tolerance = match.tolerance;
  return host;
}

}  // namespace

nook_result nook_model_match_vertices(nook_model model, const nook_vertex_match_desc* desc,
                                      uint32_t* vertices, uint32_t* unmatched) {
  return api::enter("nook_model_match_vertices", [&] {
    need(model, "model");
    const nook_vertex_match_desc match = read_descriptor(desc);
    need(vertices, "vertices");
    const HostVertices host = host_vertices(model->model, match);
    const std::uint32_t missing =
        match_vertices(model->model, host, {vertices, host.count}, model->context->memory());
    if (unmatched) *unmatched = missing;
  });
}

nook_result nook_model_remap(nook_model model, const uint32_t* vertices, uint32_t count, nook_model* out) {
  return api::enter("nook_model_remap", [&] {
    need(out, "out");
    *out = nullptr;
    need(model, "model");
    need(vertices, "vertices");
    check_fits("count", count, count != 0, "at least 1");
    const std::size_t known = model->model.file_to_welded.size();
    for (uint32_t i = 0; i < count; ++i)
      if (vertices[i] >= known)
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "vertices[%u] is %s (got %u, need less than %zu); match with a larger tolerance, or check the "
            "mesh",
            i, vertices[i] == NOOK_NO_VERTEX ? "NOOK_NO_VERTEX" : "out of range", vertices[i], known);
    const auto context = Ref<nook_context_s>::share(model->context);
    const auto remap = [&](Memory* memory) { return remapped(model->model, {vertices, count}, memory); };
    *out = Owned<nook_model_s>::make(context->memory(), context, context, remap).detach();
  });
}

nook_result nook_model_resample(nook_model model, const nook_vertex_match_desc* desc, nook_model* out) {
  return api::enter("nook_model_resample", [&] {
    need(out, "out");
    *out = nullptr;
    need(model, "model");
    const nook_vertex_match_desc mesh = read_descriptor(desc);
    constexpr float default_tolerance = 0.05f;
    HostVertices host = host_vertices(model->model, mesh);
    if (mesh.tolerance == 0) host.tolerance = default_tolerance;
    check_fits("desc.vertex_count", host.count, host.count != 0, "at least 1");
    Memory* const memory = model->context->memory();
    const FarVertex farthest = farthest_vertex(model->model, host, memory);
    const float tolerance = tolerance_of(model->model, host);
    if (!(farthest.distance <= tolerance))
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "vertex %u of the mesh is too far from every baked vertex that faces the same way (got %g, need at "
          "most %g, in the unit of desc.positions); give the mesh in its rest pose and space, or a larger "
          "tolerance",
          farthest.vertex, double(farthest.distance), double(tolerance));
    const auto context = Ref<nook_context_s>::share(model->context);
    const auto resample = [&](Memory* own) { return resampled(model->model, host, own); };
    *out = Owned<nook_model_s>::make(memory, context, context, resample).detach();
  });
}
