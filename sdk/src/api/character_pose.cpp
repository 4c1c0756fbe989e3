#include <nook/nook_pose.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/character/bone_names.h"
#include "sdk/src/character/pose_check.h"
#include "sdk/src/character/vertex_match.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/core/place.h"

using namespace nook;

namespace {

constexpr std::size_t first_pose_desc = offsetof(nook_pose_desc, place_3x4) + sizeof(const float*);

nook_pose_desc default_pose_desc() {
  nook_pose_desc desc{};
  desc.struct_size = sizeof desc;
  desc.header_version = NOOK_VERSION;
  return desc;
}

Affine read_place(const float* matrix_3x4, const char* name) {
  if (!matrix_3x4) return {};
  Mat3x4 given;
  std::copy_n(matrix_3x4, 12, given.m);
  if (!is_pose_matrix(given))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is not finite or far too large", name);
  return to_double(given);
}

// The position of a skin of the file among those of the model.
std::uint32_t find_skin(const CharacterModel& model, std::uint32_t file_index) {
  const auto found = std::find_if(model.bind.skins.begin(), model.bind.skins.end(),
                                  [&](const SkinBind& skin) { return skin.file_index == file_index; });
  if (found == model.bind.skins.end())
    throw Failure(
        model.bind.empty() ? NOOK_ERROR_UNSUPPORTED : NOOK_ERROR_INVALID_ARGUMENT,
        "desc.skin is none of the model's %zu skins (got %u); nook_character_model_skin lists them, "
        "and a model without bind data or from arrays has none",
        model.bind.skins.size(), file_index);
  return static_cast<std::uint32_t>(found - model.bind.skins.begin());
}

PoseSource source_of(const CharacterModel& model, const nook_pose_desc* given) {
  const nook_pose_desc desc =
      read_descriptor(given, "nook_pose_desc_init", first_pose_desc, default_pose_desc());
  constexpr std::uint32_t known = NOOK_POSE_PARTIAL | NOOK_POSE_STRICT;
  if (desc.flags & ~known)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.flags has unknown bits (got 0x%x, need a sum of 0x%x)",
                  desc.flags, known);
  if (desc.bone_count > 0) need(desc.transform_of_bone, "desc.transform_of_bone");
  if (desc.transform_of_bone && desc.bone_count != model.bone_count())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "desc.bone_count is not the model's (got %u, need %zu)",
                  desc.bone_count, model.bone_count());
  PoseSource source;
  source.kind = desc.kind;
  source.layout = desc.layout;
  source.transforms = desc.transforms;
  source.stride = desc.stride;
  source.transform_count = desc.transform_count;
  if (desc.kind == NOOK_POSE_SKINNING) source.skin = find_skin(model, desc.skin);
  source.transform_of_bone = {desc.transform_of_bone, desc.bone_count};
  source.is_partial = desc.flags & NOOK_POSE_PARTIAL;
  source.is_strict = desc.flags & NOOK_POSE_STRICT;
  source.place = read_place(desc.place_3x4, "desc.place_3x4");
  return source;
}

void need_bind_data(const CharacterModel& model) {
  if (model.bind.empty()) throw Failure(NOOK_ERROR_UNSUPPORTED, "the model has no bind data; bake it again");
}

void check_bone_count(const CharacterModel& model, uint32_t bone_count) {
  if (bone_count != model.bone_count())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "bone_count is not the model's (got %u, need %zu)", bone_count,
                  model.bone_count());
}

void log_projection(nook_scene scene, nook_instance_id instance, const ProjectedBone& projected) {
  if (!projected.found) return;
  const CharacterModel& model = instance_of(scene->scene, instance).model->model;
  scene->context->log(
      NOOK_LOG_WARNING,
      "instance %u: the matrix of bone %u (\"%s\") is sheared or scales unevenly and is projected "
      "to the nearest rotation with one scale; nook_character_model_check_pose tells whether the "
      "pose is right",
      instance, projected.bone, model.bone_names[projected.bone].c_str());
}

// The rest vertices and places of a check, as its caller gave them.
nook::Vector<SkinnedVertex> skinned_vertices(const CharacterModel& model, const nook_pose_check& check,
                                             nook::Memory* memory) {
  constexpr std::uint32_t min_vertices = 8;
  need(check.positions, "check.positions");
  const std::size_t known = model.bind.vertices.size();
  if (check.vertex_count < std::min<std::size_t>(min_vertices, known) || check.vertex_count > known)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "check.vertex_count is out of range (got %u, need %zu to %zu, the model's rest vertices)",
                  check.vertex_count, std::min<std::size_t>(min_vertices, known), known);
  const std::size_t stride = check.stride ? check.stride : 3 * sizeof(float);
  if (stride < 3 * sizeof(float))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "check.stride is too small (got %zu bytes, need 0 or at least 12)", stride);
  const Affine place = read_place(check.place_3x4, "check.place_3x4");
  nook::Vector<SkinnedVertex> out(memory);
  for (std::uint32_t v = 0; v < check.vertex_count; ++v) {
    const std::uint32_t rest = check.rest_vertices ? check.rest_vertices[v] : v;
    if (rest >= known)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "check.rest_vertices[%u] is out of range (got %u, need less than %zu)", v, rest, known);
    float xyz[3];
    std::memcpy(xyz, reinterpret_cast<const unsigned char*>(check.positions) + v * stride, sizeof xyz);
    for (const float coordinate : xyz)
      if (!(std::abs(coordinate) <= max_pose_metres))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "position %u is not finite or far too large (got %g)", v,
                      double(coordinate));
    out.push_back({rest, transform(place, xyz[0], xyz[1], xyz[2])});
  }
  return out;
}

constexpr std::size_t first_pose_check = offsetof(nook_pose_check, text) + sizeof nook_pose_check::text;

}  // namespace

nook_result nook_pose_desc_init(nook_pose_desc* desc, size_t size, uint32_t header_version) {
  return api::enter("nook_pose_desc_init", [&] {
    init_descriptor(desc, size, header_version, first_pose_desc, default_pose_desc());
  });
}

nook_result nook_scene_set_pose(nook_scene scene, nook_instance_id instance, const float* bones_3x4,
                                uint32_t bone_count) {
  return api::enter("nook_scene_set_pose", [&] {
    need(scene, "scene");
    need(bones_3x4, "bones_3x4");
    static_assert(sizeof(Mat3x4) == 12 * sizeof(float) && alignof(Mat3x4) == alignof(float));
    log_projection(
        scene, instance,
        set_pose(scene->scene, instance, std::span(reinterpret_cast<const Mat3x4*>(bones_3x4), bone_count)));
  });
}

nook_result nook_scene_set_pose_from(nook_scene scene, nook_instance_id instance,
                                     const nook_pose_desc* desc) {
  return api::enter("nook_scene_set_pose_from", [&] {
    need(scene, "scene");
    const CharacterModel& model = instance_of(scene->scene, instance).model->model;
    log_projection(scene, instance, set_pose(scene->scene, instance, source_of(model, desc)));
  });
}

nook_result nook_character_model_convert_pose(nook_character_model model, const nook_pose_desc* desc,
                                              float* bones_3x4, uint32_t bone_count) {
  return api::enter("nook_character_model_convert_pose", [&] {
    need(model, "model");
    need(bones_3x4, "bones_3x4");
    check_bone_count(model->model, bone_count);
    PoseSource source = source_of(model->model, desc);
    check_pose_source(model->model, source);
    convert_pose(model->model, source, {reinterpret_cast<Mat3x4*>(bones_3x4), bone_count});
  });
}

nook_result nook_character_model_map_bones(nook_character_model model, const nook_bone_names* names,
                                           int32_t* transform_of_bone, uint32_t bone_count,
                                           uint32_t* unmatched) {
  return api::enter("nook_character_model_map_bones", [&] {
    need(model, "model");
    need(names, "names");
    need(transform_of_bone, "transform_of_bone");
    check_bone_count(model->model, bone_count);
    constexpr std::size_t size = offsetof(nook_bone_names, model_suffix) + sizeof(const char*);
    if (names->struct_size < size)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "names.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                    names->struct_size, size);
    constexpr std::uint32_t known = NOOK_BONE_NAMES_LOOSE | NOOK_BONE_NAMES_DROP_SHARED_PREFIX;
    if ((names->flags & ~known) || names->reserved)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "names.flags or names.reserved has unknown bits (got 0x%x and 0x%x)", names->flags,
                    names->reserved);
    if (names->name_count) need(names->names, "names.names");
    const std::size_t missing =
        map_bones(model->model, *names, {transform_of_bone, bone_count}, model->context->memory());
    if (unmatched) *unmatched = static_cast<uint32_t>(missing);
  });
}

nook_result nook_character_model_skin(nook_character_model model, uint32_t skin, nook_skin_info* info) {
  return api::enter("nook_character_model_skin", [&] {
    need(model, "model");
    const BindData& bind = model->model.bind;
    need_bind_data(model->model);
    if (skin >= bind.skins.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "skin is out of range (got %u, need less than %zu)", skin,
                    bind.skins.size());
    nook_skin_info answer{};
    answer.file_index = bind.skins[skin].file_index;
    answer.joint_count = bind.skins[skin].joint_count;
    std::copy_n(bind.rest_from_mesh[bind.skins[skin].space].m, 12, answer.rest_from_mesh_3x4);
    write_info(info, sizeof answer, answer);
  });
}

nook_result nook_character_model_bone_bind(nook_character_model model, uint32_t bone,
                                           float node_from_rest_3x4[12]) {
  return api::enter("nook_character_model_bone_bind", [&] {
    need(model, "model");
    need(node_from_rest_3x4, "node_from_rest_3x4");
    need_bind_data(model->model);
    if (bone >= model->model.bone_count())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "bone is out of range (got %u, need less than %zu)", bone,
                    model->model.bone_count());
    std::copy_n(model->model.bind.bones[bone].node_from_rest.m, 12, node_from_rest_3x4);
  });
}

nook_result nook_character_model_rest_vertex(nook_character_model model, uint32_t index,
                                             nook_rest_vertex* vertex) {
  return api::enter("nook_character_model_rest_vertex", [&] {
    need(model, "model");
    const CharacterModel& m = model->model;
    need_bind_data(m);
    if (index >= m.bind.vertices.size())
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "index is out of range (got %u, need less than %zu)", index,
                    m.bind.vertices.size());
    const RestVertex& rest = m.bind.vertices[index];
    const Mat3x4& rest_from_mesh = m.bind.rest_from_mesh[space_of(m, rest.file_vertex)];
    const Vec3 in_mesh = transform(inverse(to_double(rest_from_mesh)), rest.position);
    nook_rest_vertex answer{};
    answer.vertex = rest.file_vertex;
    answer.position[0] = rest.position.x;
    answer.position[1] = rest.position.y;
    answer.position[2] = rest.position.z;
    answer.mesh_position[0] = in_mesh.x;
    answer.mesh_position[1] = in_mesh.y;
    answer.mesh_position[2] = in_mesh.z;
    answer.bone = rest.bone[0];
    write_info(vertex, sizeof answer, answer);
  });
}

nook_result nook_character_model_check_pose(nook_character_model model, const nook_pose_desc* desc,
                                            nook_pose_check* check) {
  return api::enter("nook_character_model_check_pose", [&] {
    need(model, "model");
    need(check, "check");
    if (check->struct_size < first_pose_check)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "check.struct_size is too small (got %u, need at least %zu); set it to sizeof",
                    check->struct_size, first_pose_check);
    need_bind_data(model->model);
    constexpr float default_tolerance = 0.005f;
    if (!(check->tolerance >= 0 && check->tolerance <= 1))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "check.tolerance is out of range (got %g, need 0 to 1)",
                    double(check->tolerance));
    PoseSource source = source_of(model->model, desc);
    check_pose_source(model->model, source);
    nook::Memory* const memory = model->context->memory();
    const auto vertices = skinned_vertices(model->model, *check, memory);
    const double tolerance = check->tolerance > 0 ? check->tolerance : default_tolerance;
    const PoseFinding finding = find_pose_fault(model->model, source, vertices, tolerance, memory);
    check->fault = finding.fault;
    check->max_error = static_cast<float>(finding.max_error);
    check->rms_error = static_cast<float>(finding.rms_error);
    check->worst_bone = finding.worst_bone;
    check->fitting_skin = finding.fitting_skin;
    check->scale = static_cast<float>(finding.scale);
    std::memcpy(check->text, finding.text, sizeof check->text);
  });
}
