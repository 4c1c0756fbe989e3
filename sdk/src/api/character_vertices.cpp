#include <nook/experimental/nook_lod.h>
#include <nook/experimental/nook_match.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/face_normals.h"
#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/vertex_match.h"
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

std::span<const std::uint16_t> bones_of_skin(const CharacterModel& model, std::uint32_t file_skin) {
  const BindData& bind = model.bind;
  for (const SkinBind& skin : bind.skins)
    if (skin.file_index == file_skin)
      return std::span(bind.bone_of_joint).subspan(skin.first_joint, skin.joint_count);
  if (bind.skins.empty() && file_skin == 0) return {};
  throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                "desc.skin is not a skin of the model (got %u; the model has %zu skins, and the first one "
                "has index %u); nook_model_describe_skin lists them",
                file_skin, bind.skins.size(), bind.skins.empty() ? 0 : bind.skins.front().file_index);
}

void check_host_weights(const HostWeights& host, std::uint32_t count, std::size_t joints) {
  for (std::uint32_t i = 0; i < count; ++i)
    for (std::uint32_t k = 0; k < host.influences; ++k) {
      const float weight = host.weight_at(i, k);
      if (!(std::isfinite(weight) && weight >= 0))
        throw Failure(
            NOOK_ERROR_INVALID_ARGUMENT,
            "desc.weights[%u] of vertex %u is out of range (got %g, need a finite number, 0 or more)", k, i,
            double(weight));
      // Engines leave arbitrary joint indices where the weight is 0, so these are not checked. The first
      // joint is always checked, because a vertex without weights follows its first joint.
      if ((weight > 0 || k == 0) && host.joint_at(i, k) >= joints)
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "desc.joints[%u] of vertex %u is out of range (got %u, need less than %zu, the number "
                      "of joints of desc.skin); match the meshes of each skin in a separate call",
                      k, i, host.joint_at(i, k), joints);
    }
}

HostWeights host_weights(const CharacterModel& model, const nook_vertex_match_desc& match) {
  HostWeights host;
  if (!match.joints != !match.weights)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.%s is NULL, but desc.%s is not; give both or neither",
                  match.joints ? "weights" : "joints", match.joints ? "joints" : "weights");
  if (!match.joints) return host;
  check_range("desc.influences", match.influences, 1u, BoneWeights::max_bones);
  host.joint = match.joints;
  host.weight = match.weights;
  host.influences = match.influences;
  host.joint_stride = checked_stride("desc.joint_stride", match.joint_stride, match.vertex_count,
                                     match.influences * sizeof(std::uint16_t));
  host.weight_stride = checked_stride("desc.weight_stride", match.weight_stride, match.vertex_count,
                                      match.influences * sizeof(float));
  host.bone_of_joint = bones_of_skin(model, match.skin);
  check_host_weights(host, match.vertex_count,
                     host.bone_of_joint.empty() ? model.bone_count() : host.bone_of_joint.size());
  return host;
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
  host.weights = host_weights(model, match);
  host.in_rest_space = match.in_rest_space != 0;
  host.primitive = match.primitive;
  if (match.tolerance > 0) host.tolerance = match.tolerance;
  return host;
}

// Returns a hint for the message: which additional data could distinguish vertices at the same place.
const char* missing_evidence(const nook_vertex_match_desc& match, bool has_triangles) {
  if (!match.normals) return "also set desc.normals";
  if (!match.joints) return "also set desc.joints and desc.weights";
  if (match.primitive < 0) return "match each primitive in a separate call";
  if (!has_triangles) return "call nook_model_match_mesh, which also uses the triangles";
  return "keep the order of the file's vertices, or move the vertices apart and bake again";
}

void describe_matches(const CharacterModel& model, const VertexMatches& matches,
                      const nook_vertex_match_desc& match, bool has_triangles, nook_vertex_match_info& info) {
  info.unmatched = matches.unmatched;
  info.ambiguous = matches.ambiguous;
  int used = 0;
  if (matches.unmatched > match.vertex_count / 2)
    used = std::snprintf(info.text, sizeof info.text,
                         "%u of %u vertices are not near any of the model's %zu vertices; either the model "
                         "was baked for another mesh and you need the model of this mesh, or the positions "
                         "have another unit or space (see desc.in_rest_space)",
                         matches.unmatched, match.vertex_count, model.file_to_welded.size());
  else if (matches.unmatched > 0)
    used = std::snprintf(info.text, sizeof info.text,
                         "%u of %u vertices are not near any vertex of the model; the first is vertex %u; "
                         "check the mesh and its unit",
                         matches.unmatched, match.vertex_count, matches.first_unmatched);
  if (matches.ambiguous > 0)
    std::snprintf(info.text + used, sizeof info.text - static_cast<std::size_t>(used),
                  "%s%u of %u vertices match several model vertices with different AO; the first is vertex "
                  "%u, which matches %u and %u; %s",
                  used > 0 ? ". " : "", matches.ambiguous, match.vertex_count, matches.first_ambiguous,
                  matches.taken, matches.other, missing_evidence(match, has_triangles));
}

void check_indices(const uint32_t* indices, size_t count, std::uint32_t vertices) {
  need(indices, "indices");
  check_fits("index_count", count, count % 3 == 0, "a multiple of 3");
  for (std::size_t i = 0; i < count; ++i)
    if (indices[i] >= vertices)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "indices[%zu] is out of range (got %u, need less than desc.vertex_count, %u)", i,
                    indices[i], vertices);
}

// `call` is the name of the C function, for the log.
void match(const nook_model_s& model, const nook_vertex_match_desc& match, const HostVertices& host,
           const char* call, uint32_t* vertices, nook_vertex_match_info* info) {
  const VertexMatches matches =
      match_vertices(model.model, host, {vertices, host.count}, model.context->memory());
  nook_vertex_match_info answer{};
  describe_matches(model.model, matches, match, host.face_normal.first != nullptr, answer);
  if (matches.ambiguous > 0) model.context->log(NOOK_LOG_WARNING, "%s: %s", call, answer.text);
  if (info) write_info(info, answer);
}

// `i` is the first vertex without a match.
[[noreturn]] void refuse_vertex(std::span<const uint32_t> vertices, uint32_t i, std::size_t known) {
  if (vertices[i] != NOOK_NO_VERTEX)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "vertices[%u] is out of range (got %u, need less than %zu)", i,
                  vertices[i], known);
  const auto missing = std::count(vertices.begin(), vertices.end(), NOOK_NO_VERTEX);
  throw Failure(
      NOOK_ERROR_INVALID_ARGUMENT,
      "vertices[%u] is NOOK_NO_VERTEX, as are %td of %zu (need less than %zu); match with a larger "
      "tolerance, "
      "or check the mesh and its unit. Draw a part that was not baked without Nook: with the constant vertex "
      "attribute 1 in place of AO (glDisableVertexAttribArray and glVertexAttrib1f), or bake it too",
      i, missing, vertices.size(), known);
}

}  // namespace

nook_result nook_model_match_vertices(nook_model model, const nook_vertex_match_desc* desc,
                                      uint32_t* vertices, nook_vertex_match_info* info) {
  return api::enter("nook_model_match_vertices", [&] {
    need(model, "model");
    const nook_vertex_match_desc given = read_descriptor(desc);
    need(vertices, "vertices");
    match(*model, given, host_vertices(model->model, given), "nook_model_match_vertices", vertices, info);
  });
}

nook_result nook_model_match_mesh(nook_model model, const nook_vertex_match_desc* desc,
                                  const uint32_t* indices, size_t index_count, uint32_t* vertices,
                                  nook_vertex_match_info* info) {
  return api::enter("nook_model_match_mesh", [&] {
    need(model, "model");
    const nook_vertex_match_desc given = read_descriptor(desc);
    need(vertices, "vertices");
    HostVertices host = host_vertices(model->model, given);
    check_indices(indices, index_count, host.count);
    const Vector<Vec3> normals = face_normals_of(host, {indices, index_count}, model->context->memory());
    host.face_normal = {normals.empty() ? nullptr : &normals[0].x, sizeof(Vec3)};
    match(*model, given, host, "nook_model_match_mesh", vertices, info);
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
      if (vertices[i] >= known) refuse_vertex({vertices, count}, i, known);
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
