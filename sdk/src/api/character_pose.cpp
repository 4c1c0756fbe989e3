#include <nook/experimental/nook_poses.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>

#include "sdk/src/api/descriptor_list.h"
#include "sdk/src/api/entry.h"
#include "sdk/src/api/handles.h"
#include "sdk/src/api/pose_descriptor.h"
#include "sdk/src/api/pose_log.h"
#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/pose_check.h"
#include "sdk/src/character/pose_source.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/geometry.h"

using namespace nook;

namespace {

Affine read_place(const float* matrix_3x4, const char* name) {
  if (!matrix_3x4) return {};
  Mat3x4 given;
  std::copy_n(matrix_3x4, 12, given.m);
  if (!is_pose_matrix(given))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s is not finite or far too large", name);
  return to_double(given);
}

}  // namespace

PoseSource nook::api::source_of(const CharacterModel& model, const nook_pose_desc* given) {
  const nook_pose_desc desc = read_descriptor(given);
  constexpr std::uint32_t known = NOOK_POSE_FLAG_PARTIAL | NOOK_POSE_FLAG_STRICT | NOOK_POSE_FLAG_SURPLUS;
  if (desc.flags & ~known)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.flags has unknown bits (got 0x%x, the known bits are 0x%x)", desc.flags, known);
  if (desc.bone_count > 0) need(desc.transform_of_bone, "desc.transform_of_bone");
  if (desc.transform_of_bone && desc.bone_count != model.bone_count())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "desc.bone_count differs from the model's bone count (got %u, need %zu)", desc.bone_count,
                  model.bone_count());
  PoseSource source;
  source.kind = desc.kind;
  source.layout = desc.layout;
  source.transforms = desc.transforms;
  source.stride = desc.stride;
  source.transform_count = desc.transform_count;
  source.file_skin = desc.skin;
  source.transform_of_bone = {desc.transform_of_bone, desc.bone_count};
  source.is_partial = desc.flags & NOOK_POSE_FLAG_PARTIAL;
  source.is_strict = desc.flags & NOOK_POSE_FLAG_STRICT;
  source.allows_surplus = desc.flags & NOOK_POSE_FLAG_SURPLUS;
  source.place = read_place(desc.place_3x4, "desc.place_3x4");
  return source;
}

namespace {

// Returns the vertices that the pose check compares, at the positions that the caller passed.
nook::Vector<SkinnedVertex> skinned_vertices(const CharacterModel& model, const nook_pose_check_desc& check,
                                             nook::Memory* memory) {
  constexpr std::uint32_t min_vertices = 8;
  need(check.positions, "check.positions");
  const std::size_t known = model.bind.vertices.size();
  if (check.vertex_count < std::min<std::size_t>(min_vertices, known) || check.vertex_count > known)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "check.vertex_count is out of range (got %u, need %zu to %zu, the model's check vertices)",
                  check.vertex_count, std::min<std::size_t>(min_vertices, known), known);
  const std::size_t stride =
      checked_stride("check.stride", check.stride, check.vertex_count, 3 * sizeof(float));
  const Affine place = read_place(check.place_3x4, "check.place_3x4");
  nook::Vector<SkinnedVertex> out(memory);
  for (std::uint32_t v = 0; v < check.vertex_count; ++v) {
    const std::uint32_t rest = check.check_vertices ? check.check_vertices[v] : v;
    if (rest >= known)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "check.check_vertices[%u] is out of range (got %u, need less than %zu)", v, rest, known);
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

// A batch of poses of one model, and the memory to which their AO is written.
struct PoseBatch {
  nook_model_s& model;
  SceneSettings settings;
  PoseSource first;
  std::size_t stride = 0;         // distance between poses in bytes
  const Plane* ground = nullptr;  // null: none
  float* ao = nullptr;
};

// Consecutive poses, which one job evaluates.
struct PoseRun {
  std::uint32_t begin = 0, end = 0;
  std::array<PoseNotes, 3> notes;  // for each topic, the notes of the first pose to which the topic applies
  std::exception_ptr failure;      // the failure of the pose at `begin`, if any; `begin` is incremented after
                                   // each pose that succeeds
};

// Stores the notes, so that they can be logged later. Jobs must not log, because the host may not expect log
// messages on their threads.
void keep_notes(PoseRun& run, const PoseNotes& notes) {
  for (std::size_t t = 0; t < run.notes.size(); ++t)
    if ((notes.topics() >> t & 1) && !run.notes[t].topics()) run.notes[t] = notes;
}

// Returns the distance between poses in bytes. The default is the size of all transforms of one pose.
std::size_t batch_stride(const CharacterModel& model, PoseSource source, std::size_t pose_stride,
                         std::uint32_t pose_count) {
  check_pose_source(model, source);
  if (pose_stride % sizeof(float))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "pose_stride is not a multiple of 4 (got %zu bytes)",
                  pose_stride);
  return checked_stride("pose_stride", pose_stride, pose_count, source.stride * source.given_count);
}

// Returns the number of runs into which the poses are divided. It is small, because each run needs its own
// scene.
std::uint32_t run_count(const Parallel& parallel, std::uint32_t pose_count) {
  constexpr std::uint32_t min_poses = 8, max_runs = 64;
  return parallel.run ? std::clamp(pose_count / min_poses, 1u, max_runs) : 1;
}

void evaluate_run(const PoseBatch& batch, PoseRun& run, nook::Memory* memory) {
  Scene scene(batch.settings, {}, memory);
  const nook_instance_id id = add_instance(scene, Ref<const LoadedModel>::share(&batch.model));
  const Instance& instance = instance_of(scene, id);
  if (batch.ground) set_ground(scene, id, batch.ground);
  const Vector<Mat3x4> rest(instance.bones(), memory);
  const std::size_t vertices = batch.model.model.file_to_welded.size();
  for (; run.begin < run.end; ++run.begin) {
    PoseSource source = batch.first;
    source.transforms = reinterpret_cast<const float*>(
        reinterpret_cast<const unsigned char*>(batch.first.transforms) + run.begin * batch.stride);
    if (source.is_partial) set_pose(scene, id, rest);
    keep_notes(run, set_pose(scene, id, source));
    update(scene);
    read_ao_as(scene, instance, NOOK_FORMAT_FLOAT, batch.ao + run.begin * vertices, sizeof(float));
  }
}

// If some poses failed, throws the failure of the first one. The message also contains the index of this
// pose.
void rethrow_first(std::span<const PoseRun> runs) {
  for (const PoseRun& run : runs) try {
      if (run.failure) std::rethrow_exception(run.failure);
    } catch (const Failure& failure) {
      throw Failure(failure.code(), "pose %u: %s", run.begin, failure.what());
    }
}

void evaluate_batch(const PoseBatch& batch, std::uint32_t pose_count, Context& context) {
  nook::Vector<PoseRun> runs(run_count(context.parallel(), pose_count), context.memory());
  const auto count = static_cast<std::uint32_t>(runs.size());
  auto evaluate = [&](std::uint32_t r) noexcept {
    PoseRun& run = runs[r];
    run.begin = static_cast<std::uint32_t>(std::uint64_t{pose_count} * r / count);
    run.end = static_cast<std::uint32_t>(std::uint64_t{pose_count} * (r + 1) / count);
    try {
      evaluate_run(batch, run, context.memory());
    } catch (...) {
      run.failure = std::current_exception();
    }
  };
  parallel_for(context.parallel(), count, evaluate);
  rethrow_first(runs);
  for (const PoseRun& run : runs)
    for (const PoseNotes& notes : run.notes)
      api::log_pose(context, "nook_model_evaluate_poses", batch.model.model, notes, batch.model.reported);
}

}  // namespace

nook_result nook_scene_set_pose(nook_scene scene, nook_instance_id instance, const nook_pose_desc* desc) {
  return api::enter("nook_scene_set_pose", [&] {
    need(scene, "scene");
    Instance& posed = instance_of(scene->scene, instance);
    const CharacterModel& model = posed.model->model;
    const PoseNotes notes = set_pose(scene->scene, instance, api::source_of(model, desc));
    api::log_pose(*scene->context, posed, notes);
  });
}

nook_result nook_model_convert_pose(nook_model model, const nook_pose_desc* desc, float* bones_3x4,
                                    uint32_t bone_count) {
  return api::enter("nook_model_convert_pose", [&] {
    need(model, "model");
    need(bones_3x4, "bones_3x4");
    check_bone_count(bone_count, model->model.bone_count());
    PoseSource source = api::source_of(model->model, desc);
    check_pose_source(model->model, source);
    const PoseNotes notes =
        convert_pose(model->model, source, {reinterpret_cast<Mat3x4*>(bones_3x4), bone_count});
    api::log_pose(*model->context, "nook_model_convert_pose", model->model, notes, model->reported);
  });
}

nook_result nook_model_evaluate_poses(nook_model model, const nook_scene_desc* settings,
                                      const nook_pose_desc* first, uint32_t pose_count, size_t pose_stride,
                                      const float* plane_xyzd, float* ao, size_t count) {
  return api::enter("nook_model_evaluate_poses", [&] {
    need(model, "model");
    const std::size_t vertices = model->model.file_to_welded.size();
    check_array("pose_count", pose_count, vertices * sizeof(float));
    if (count != pose_count * vertices)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "count is not pose_count times the model's file_vertex_count (got %zu, need %zu)", count,
                    pose_count * vertices);
    if (pose_count) need(ao, "ao");
    nook_context_s& context = *model->context;
    const nook_scene_desc used = settings ? read_descriptor(settings) : default_desc<nook_scene_desc>();
    PoseBatch batch{*model, settings_of(used, context), api::source_of(model->model, first)};
    batch.stride = batch_stride(model->model, batch.first, pose_stride, pose_count);
    const float* const p = plane_xyzd;
    const Plane ground = p ? Plane{{p[0], p[1], p[2]}, p[3]} : Plane{};
    batch.ground = p ? &ground : nullptr;
    batch.ao = ao;
    evaluate_batch(batch, pose_count, context);
  });
}

nook_result nook_model_map_bones(nook_model model, const nook_bone_map_desc* desc, int32_t* transform_of_bone,
                                 uint32_t bone_count, uint32_t* unmatched) {
  return api::enter("nook_model_map_bones", [&] {
    need(model, "model");
    const nook_bone_map_desc rules = read_descriptor(desc);
    need(transform_of_bone, "transform_of_bone");
    check_bone_count(bone_count, model->model.bone_count());
    constexpr std::uint32_t known = NOOK_BONE_MAP_LOOSE | NOOK_BONE_MAP_DROP_SHARED_PREFIX;
    if (rules.flags & ~known)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "desc.flags has unknown bits (got 0x%x, the known bits are 0x%x)", rules.flags, known);
    if (rules.name_count) need(rules.names, "desc.names");
    const std::size_t missing =
        map_bones(model->model, rules, {transform_of_bone, bone_count}, model->context->memory());
    if (unmatched) *unmatched = static_cast<uint32_t>(missing);
  });
}

nook_result nook_model_describe_skin(nook_model model, uint32_t skin, nook_skin_info* info) {
  return api::enter("nook_model_describe_skin", [&] {
    need(model, "model");
    const BindData& bind = model->model.bind;
    need_bind_data(model->model);
    check_index("skin", skin, bind.skins.size());
    nook_skin_info answer{};
    answer.file_index = bind.skins[skin].file_index;
    answer.joint_count = bind.skins[skin].joint_count;
    std::copy_n(bind.rest_from_mesh[bind.skins[skin].space].m, 12, answer.rest_from_mesh_3x4);
    write_info(info, answer);
  });
}

nook_result nook_model_describe_check_vertex(nook_model model, uint32_t index, nook_check_vertex_info* info) {
  return api::enter("nook_model_describe_check_vertex", [&] {
    need(model, "model");
    const CharacterModel& m = model->model;
    need_bind_data(m);
    check_index("index", index, m.bind.vertices.size());
    const RestVertex& rest = m.bind.vertices[index];
    const Mat3x4& rest_from_mesh = m.bind.rest_from_mesh[space_of(m, rest.file_vertex)];
    const Vec3 in_mesh = transform(inverse(to_double(rest_from_mesh)), rest.position);
    nook_check_vertex_info answer{};
    answer.vertex = rest.file_vertex;
    answer.position[0] = rest.position.x;
    answer.position[1] = rest.position.y;
    answer.position[2] = rest.position.z;
    answer.mesh_position[0] = in_mesh.x;
    answer.mesh_position[1] = in_mesh.y;
    answer.mesh_position[2] = in_mesh.z;
    answer.bone = rest.bone[0];
    write_info(info, answer);
  });
}

nook_result nook_model_check_pose(nook_model model, const nook_pose_desc* desc,
                                  const nook_pose_check_desc* check, nook_pose_check_info* info) {
  return api::enter("nook_model_check_pose", [&] {
    need(model, "model");
    need(check, "check");
    const nook_pose_check_desc given = read_descriptor(check);
    check_fits("check.tolerance", given.tolerance, given.tolerance > 0 && given.tolerance <= 1,
               "above 0, at most 1");
    PoseSource source = api::source_of(model->model, desc);
    check_pose_source(model->model, source, true);
    nook::Memory* const memory = model->context->memory();
    const auto vertices = skinned_vertices(model->model, given, memory);
    const Affine place = read_place(given.place_3x4, "check.place_3x4");
    const PoseFinding finding =
        find_pose_fault(model->model, source, vertices, place, given.tolerance, memory);
    nook_pose_check_info answer{};
    answer.fault = finding.fault;
    answer.max_error = static_cast<float>(finding.max_error);
    answer.rms_error = static_cast<float>(finding.rms_error);
    answer.worst_bone = finding.worst_bone;
    answer.fitting_skin = finding.fitting_skin;
    answer.scale = static_cast<float>(finding.scale);
    std::memcpy(answer.text, finding.text, sizeof answer.text);
    write_info(info, answer);
  });
}
