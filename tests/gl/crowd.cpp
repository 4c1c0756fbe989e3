#include "tests/gl/crowd.h"

#include <cstdlib>

#include "bakers/character/levels.h"
#include "sdk/src/character/model_file.h"
#include "tests/pose_of_rows.h"

namespace nook::test {
namespace {

void* counted_allocate(void* user, std::size_t size, std::size_t alignment) {
  auto& context = *static_cast<CountedContext*>(user);
  if (context.refuse_after == 0) return nullptr;
  if (context.refuse_after > 0) --context.refuse_after;
  ++context.allocations;
  context.bytes += static_cast<long long>(size);
  return ::operator new(size, std::align_val_t(alignment));
}

void counted_release(void* user, void* memory, std::size_t size, std::size_t alignment) {
  static_cast<CountedContext*>(user)->bytes -= static_cast<long long>(size);
  ::operator delete(memory, std::align_val_t(alignment));
}

void keep_log(void* user, nook_log_severity, const char* text) {
  static_cast<CountedContext*>(user)->log.emplace_back(text);
}

Mat3x4 turned(Vec3 axis, float angle, float scale, Vec3 move) {
  const float c = std::cos(angle), s = std::sin(angle), t = 1 - c;
  const Vec3 a = axis;
  const float r[9] = {t * a.x * a.x + c,       t * a.x * a.y - s * a.z, t * a.x * a.z + s * a.y,
                      t * a.x * a.y + s * a.z, t * a.y * a.y + c,       t * a.y * a.z - s * a.x,
                      t * a.x * a.z - s * a.y, t * a.y * a.z + s * a.x, t * a.z * a.z + c};
  return {{scale * r[0], scale * r[1], scale * r[2], move.x, scale * r[3], scale * r[4], scale * r[5], move.y,
           scale * r[6], scale * r[7], scale * r[8], move.z}};
}

}  // namespace

CountedContext::CountedContext() {
  nook_context_desc desc;
  NOOK_OK_OR_FAIL(nook_context_desc_init(&desc));
  desc.allocator = {this, counted_allocate, counted_release};
  desc.log = keep_log;
  desc.log_user = this;
  NOOK_OK_OR_FAIL(nook_context_create(&desc, &handle));
}

CountedContext::~CountedContext() {
  nook_context_destroy(&handle);
}

std::vector<Mat3x4> random_pose(Numbers& numbers, std::size_t bones, Vec3 at, float scale) {
  std::vector<Mat3x4> pose(bones);
  for (Mat3x4& bone : pose)
    bone = turned(numbers.direction(), numbers.between(-0.6f, 0.6f), scale, at + numbers.place(0.1f) * scale);
  return pose;
}

nook_model load_model(nook_context context, const CharacterModel& model) {
  const std::vector<std::byte> bytes = write_character_model(model);
  nook_model loaded = nullptr;
  NOOK_OK_OR_FAIL(nook_model_load(context, bytes.data(), bytes.size(), &loaded));
  return loaded;
}

Crowd::Crowd(nook_context context, const std::vector<nook_model>& models,
             const std::vector<std::uint32_t>& bone_counts, const CrowdOptions& crowd_options)
    : options(crowd_options), models_(models), bone_counts_(bone_counts) {
  nook_scene_desc desc;
  NOOK_OK_OR_FAIL(nook_scene_desc_init(&desc));
  desc.form = options.form;
  desc.cutoff_error = options.cutoff_error;
  desc.far_error = 0;  // the compute tier merges nothing
  desc.lod_error = options.lod_error;
  desc.lod_max_interval = options.lod_max_interval;
  desc.lod_distance = 1;
  NOOK_OK_OR_FAIL(nook_scene_create(context, &desc, &scene));
  for (std::size_t i = 0; i < options.instances; ++i) add(i);
  if (options.links)
    for (std::size_t i = 1; i < ids.size(); ++i) NOOK_OK_OR_FAIL(nook_scene_link(scene, ids[i], ids[i - 1]));
  if (options.nearest) NOOK_OK_OR_FAIL(nook_scene_link_nearest(scene, 3, 3.0f * options.spacing));
  if (options.occluders)
    for (int i = 0; i < 3; ++i) {
      const Vec3 at = options.offset + Vec3{0.9f * static_cast<float>(i), 0.3f, 0.5f};
      const nook_occluder ball{{at.x, at.y, at.z}, 0.2f + 0.1f * static_cast<float>(i), 0};
      nook_occluder_id occluder = 0;
      NOOK_OK_OR_FAIL(nook_scene_add_occluder(scene, &ball, &occluder));
    }
  if (options.camera) {
    const float eye[3] = {options.offset.x, options.offset.y, options.offset.z};
    NOOK_OK_OR_FAIL(nook_scene_set_camera(scene, eye));
  }
}

nook_instance_id Crowd::add(std::size_t index) {
  nook_instance_id id = 0;
  NOOK_OK_OR_FAIL(nook_scene_add_instance(scene, models_[index % models_.size()], &id));
  ids.push_back(id);
  const float plane[4] = {0, 1, 0, options.offset.y - 0.6f * options.scale};
  if (options.ground && index % 3 != 2) NOOK_OK_OR_FAIL(nook_scene_set_ground(scene, id, plane));
  pose_one(index, 0);
  return id;
}

void Crowd::pose(std::uint32_t frame) {
  for (std::size_t i = 0; i < ids.size(); ++i) pose_one(i, frame);
}

void Crowd::pose_one(std::size_t index, std::uint32_t frame) {
  Numbers numbers(static_cast<std::uint32_t>(index * 977 + frame * 31 + 5));
  const std::uint32_t side = 1 + static_cast<std::uint32_t>(std::sqrt(static_cast<float>(options.instances)));
  const Vec3 at =
      options.offset + Vec3{static_cast<float>(index % side), 0, static_cast<float>(index / side)} *
                           (options.spacing * options.scale);
  const std::vector<Mat3x4> bones =
      random_pose(numbers, bone_counts_[index % bone_counts_.size()], at, options.scale);
  NOOK_OK_OR_FAIL(nook::test::set_rows(scene, ids[index], bones.data()->m, bones.size()));
}

namespace {

// Returns the error of the coarsest.
float add_levels(CharacterModel& model) {
  Numbers numbers(3);
  std::vector<std::vector<Mat3x4>> poses;
  for (int i = 0; i < 12; ++i) poses.push_back(random_pose(numbers, model.bone_count()));
  for (const CharacterLevel& level : bake::make_levels(model, poses)) model.levels.push_back(level);
  return model.levels.back().error_rms;
}

}  // namespace

Cast::Cast(KernelForm form, float gamma, bool levels) {
  constexpr SampleSize body{13, 70, 150, 700, 200, 8}, cloak{4, 9, 37, 90, 20, 3};
  for (const SampleSize& size : {body, cloak}) {
    CharacterModel model = sample_model(static_cast<std::uint32_t>(40 + models.size()), size);
    model.kernel = {form, gamma};
    if (levels) coarsest_error = add_levels(model);
    models.push_back(load_model(context.handle, model));
    bone_counts.push_back(size.bones);
  }
}

Cast::~Cast() {
  for (nook_model& model : models) nook_model_destroy(&model);
}

nook_scene_info stats_of(const Crowd& crowd) {
  nook_scene_info stats{};
  stats.struct_size = sizeof stats;
  NOOK_OK_OR_FAIL(nook_scene_describe(crowd.scene, &stats));
  return stats;
}

std::uint32_t file_vertices(nook_model model) {
  nook_model_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_model_describe(model, &info));
  return info.file_vertex_count;
}

std::vector<float> cpu_ao(const Crowd& crowd, nook_model model, std::size_t index) {
  std::vector<float> ao(file_vertices(model), -1.0f);
  NOOK_OK_OR_FAIL(nook_scene_read(crowd.scene, crowd.ids[index], NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT,
                                  ao.data(), static_cast<std::uint32_t>(ao.size()), 0));
  return ao;
}

std::vector<float> gpu_ao(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index) {
  std::vector<float> ao(file_vertices(model), -1.0f);
  NOOK_OK_OR_FAIL(nook_gl_scene_read(gl, crowd.scene, crowd.ids[index], NOOK_CHANNEL_AO, ao.data(),
                                     static_cast<std::uint32_t>(ao.size())));
  return ao;
}

float largest_difference(const std::vector<float>& a, const std::vector<float>& b) {
  float largest = a.size() == b.size() ? 0.0f : INFINITY;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i) {
    const float difference = std::abs(a[i] - b[i]);
    if (!(difference <= largest)) largest = difference;  // a NaN stays
  }
  return largest;
}

float difference_to_cpu(nook_gl gl, const Crowd& crowd, nook_model model, std::size_t index) {
  const std::vector<float> gpu = gpu_ao(gl, crowd, model, index);
  NOOK_OK_OR_FAIL(nook_scene_update(crowd.scene));
  return largest_difference(gpu, cpu_ao(crowd, model, index));
}

nook_gl_info info_of(nook_gl gl) {
  nook_gl_info info{};
  info.struct_size = sizeof info;
  NOOK_OK_OR_FAIL(nook_gl_describe(gl, &info));
  return info;
}

nook_gl create_gl(nook_context context, nook_gl_proc_fn loader, void* user, int tier,
                  nook_gl_state_mode mode) {
  nook_gl_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
  desc.get_proc = loader;
  desc.get_proc_user = user;
  desc.max_tier = tier;
  desc.state_mode = mode;
  nook_gl gl = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_create(context, &desc, &gl));
  return gl;
}

}  // namespace nook::test
