#include <nook/nook_vertices.h>

#include <cmath>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/vertex_match.h"
#include "sdk/src/character/vertex_resample.h"
#include "sdk/src/core/descriptors.h"

using namespace nook;

namespace {

StridedPoints points_of(const float* first, std::size_t stride, std::uint32_t count, const char* desc,
                        const char* name) {
  constexpr std::size_t size = 3 * sizeof(float);
  const StridedPoints points{first, stride ? stride : size};
  if (points.stride < size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the stride of %s.%s is too small (got %zu bytes, need 0, or %zu or more)", desc, name,
                  stride, size);
  for (std::uint32_t i = 0; first && i < count; ++i) {
    const Vec3 p = points[i];
    if (!(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.%s[%u] is not finite (got %g %g %g)", desc, name, i,
                    double(p.x), double(p.y), double(p.z));
  }
  return points;
}

// `desc` is the name of the argument in messages.
HostVertices host_vertices(const CharacterModel& model, const nook_vertex_match& match, const char* desc) {
  constexpr std::size_t size = offsetof(nook_vertex_match, reserved) + sizeof match.reserved;
  if (match.struct_size < size)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s.struct_size is too small (got %u, need at least %zu); set it to sizeof", desc,
                  match.struct_size, size);
  if (!match.positions)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.positions is NULL; a valid pointer is needed", desc);
  if (model.rest.position.empty() || model.bind.empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED, "the model has no rest positions; bake it again");
  if (match.primitive < NOOK_ALL_PRIMITIVES ||
      (match.primitive >= 0 && static_cast<std::size_t>(match.primitive) >= model.primitives.size()))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.primitive is out of range (got %d, need -1 to %zu)", desc,
                  match.primitive, model.primitives.size() - 1);
  if (match.in_rest_space > 1 || match.reserved)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s.in_rest_space or reserved is out of range (got %u and %u, need 0 or 1 and 0)", desc,
                  match.in_rest_space, match.reserved);
  if (!(match.tolerance >= 0 && match.tolerance <= 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.tolerance is out of range (got %g, need 0 to 1)", desc,
                  double(match.tolerance));
  HostVertices host;
  host.count = match.vertex_count;
  host.position = points_of(match.positions, match.position_stride, match.vertex_count, desc, "positions");
  host.normal = points_of(match.normals, match.normal_stride, match.vertex_count, desc, "normals");
  host.in_rest_space = match.in_rest_space != 0;
  host.primitive = match.primitive;
  if (match.tolerance > 0) host.tolerance = match.tolerance;
  return host;
}

}  // namespace

nook_result nook_character_model_match_vertices(nook_character_model model, const nook_vertex_match* match,
                                                uint32_t* vertices, uint32_t* unmatched) {
  return api::enter("nook_character_model_match_vertices", [&] {
    need(model, "model");
    need(match, "match");
    need(vertices, "vertices");
    const HostVertices host = host_vertices(model->model, *match, "match");
    const std::uint32_t missing =
        match_vertices(model->model, host, {vertices, host.count}, model->context->memory());
    if (unmatched) *unmatched = missing;
  });
}

nook_result nook_character_model_remap(nook_character_model model, const uint32_t* vertices, uint32_t count,
                                       nook_character_model* out) {
  return api::enter("nook_character_model_remap", [&] {
    need(out, "out");
    *out = nullptr;
    need(model, "model");
    need(vertices, "vertices");
    if (count == 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "count is out of range (got 0, need at least 1)");
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
    *out = Owned<nook_character_model_s>::make(context->memory(), context, context, remap).detach();
  });
}

nook_result nook_character_model_resample(nook_character_model model, const nook_vertex_match* mesh,
                                          nook_character_model* out) {
  return api::enter("nook_character_model_resample", [&] {
    need(out, "out");
    *out = nullptr;
    need(model, "model");
    need(mesh, "mesh");
    constexpr float default_tolerance = 0.05f;
    HostVertices host = host_vertices(model->model, *mesh, "mesh");
    if (mesh->tolerance == 0) host.tolerance = default_tolerance;
    if (host.count == 0)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "mesh.vertex_count is out of range (got 0, need at least 1)");
    Memory* const memory = model->context->memory();
    const FarVertex farthest = farthest_vertex(model->model, host, memory);
    const float tolerance = tolerance_of(model->model, host);
    if (!(farthest.distance <= tolerance))
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "vertex %u of mesh is too far from every baked vertex that faces the same way (got %g, need at "
          "most %g, in the unit of mesh.positions); give the mesh in its rest pose and space, or a larger "
          "tolerance",
          farthest.vertex, double(farthest.distance), double(tolerance));
    const auto context = Ref<nook_context_s>::share(model->context);
    const auto resample = [&](Memory* own) { return resampled(model->model, host, own); };
    *out = Owned<nook_character_model_s>::make(memory, context, context, resample).detach();
  });
}
