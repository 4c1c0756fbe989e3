#include "sdk/src/gl/character/compute_tier.h"

#include <cstdio>
#include <optional>

#include "sdk/src/character/instance_views.h"
#include "sdk/src/gl/character/compute_scene.h"
#include "sdk/src/gl/character/pending_marks.h"
#include "sdk/src/gl/shader_program.h"
#include "shaders/character/layout.h"

namespace nook::gl {
namespace {

constexpr std::uint32_t groups(std::uint32_t threads, std::uint32_t group_size) {
  return (threads + group_size - 1) / group_size;
}

void bind_stream(const Functions& gl, const ComputeScene& placed, const ComputeChunk& chunk) {
  bind_piece(gl, NOOK_BINDING_STREAM, placed.stream, chunk.frame.offset, chunk.frame.bytes);
}

struct OutputDefine {
  char text[32];
  explicit OutputDefine(int output) { std::snprintf(text, sizeof text, "#define NOOK_OUTPUT %d\n", output); }
};

// Decides which instances are due. If the update fails later, the next update evaluates these instances.
void decide(Device& device, ComputeScene& placed, Scene& scene) {
  placed.notice_lights();
  if (placed.streaming.is_used && placed.lacks_light_buffers()) placed.make_light_buffers(device);
  placed.measure();
  placed.assign(scene, 0);
  ++scene.frame;
  resolve_casters(scene, [&](std::uint32_t slot) { return placed.placements[slot].evaluated; });
  for (std::size_t slot = 0; slot < placed.placements.size(); ++slot)
    if (scene.instances[slot].plan.due) placed.placements[slot].evaluated = false;
  for (Instance& instance : scene.instances) {
    // A pending instance is not due, but the host's shader reads its light.
    const bool is_pending = placed.streaming.is_used && instance.plan.is_far;
    if (instance.light().count > 0 && (instance.plan.due || is_pending)) prepare_light(scene, instance);
  }
}

std::uint64_t count_evaluations(const ComputeScene& placed, const Scene& scene, std::uint32_t slot) {
  const Instance& instance = scene.instances[slot];
  const auto level_of = [&](std::uint32_t of) -> const LevelRange& {
    return placed.placements[of].chunk->model->level(instance.plan.level);
  };
  std::uint64_t spheres =
      (has_self_shadow(scene, instance) ? level_of(slot).spheres : 0) + free_sphere_count(instance);
  for (const std::uint32_t caster : instance.plan.casters) spheres += level_of(caster).spheres;
  return spheres * level_of(slot).key_points;
}

void count_update(const ComputeScene& placed, Scene& scene) {
  scene.stats = {};
  scene.stats.instances = scene.living;
  for (std::uint32_t slot = 0; slot < scene.instances.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    if (instance.id == 0 || !instance.plan.due) continue;
    ++scene.stats.instances_updated;
    scene.stats.links += static_cast<std::uint32_t>(instance.plan.casters.size());
    scene.stats.links_culled += instance.plan.culled;
    scene.stats.evaluations += count_evaluations(placed, scene, slot);
  }
}

void remember_update(ComputeScene& placed, const Scene& scene) {
  for (std::size_t slot = 0; slot < placed.placements.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    Placement<ComputeChunk>& placement = placed.placements[slot];
    if (instance.id == 0 || !placement.chunk || instance.plan.is_far) continue;
    placement.evaluated |= instance.plan.due;
    placement.chunk->transformed[placement.place] = pose_of(instance);
  }
}

}  // namespace

ComputeTier::ComputeTier(Device& device)
    : device_(device),
      spheres_(compute_program(device, "character/spheres.comp", "")),
      vertices_(compute_program(device, "character/vertices.comp", OutputDefine(NOOK_OUTPUT_AO).text)),
      models_(device.memory),
      scenes_(device.memory) {}

void ComputeTier::make_light_programs() {
  if (colours_spread_.name()) return;
  lit_vertices_ = compute_program(device_, "character/vertices.comp", OutputDefine(NOOK_OUTPUT_COLOUR).text);
  grey_vertices_ = compute_program(device_, "character/vertices.comp", OutputDefine(NOOK_OUTPUT_GREY).text);
  colours_spread_ = compute_program(device_, "character/colours_spread.comp", "");
}

void ComputeTier::make_clip_program() {
  if (decode_clips_.name() == 0) decode_clips_ = compute_program(device_, "character/clip_bones.comp", "");
}

void ComputeTier::make_spread_program() {
  if (spread_.name() == 0) spread_ = compute_program(device_, "character/spread.comp", "");
}

void ComputeTier::make_form_programs(int form, bool lit) {
  char defines[40];
  std::snprintf(defines, sizeof defines, "#define NOOK_KERNEL_FORM %d\n", form);
  if (shadows_[form].name() == 0)
    shadows_[form] = compute_program(device_, "character/shadows.comp", defines);
  if (lit && colours_[form].name() == 0)
    colours_[form] = compute_program(device_, "character/colours.comp", defines);
}

void ComputeTier::make_programs(const ComputeScene& placed) {
  const bool lit = placed.lights.made();
  if (lit) make_light_programs();
  if (!placed.clips.empty()) make_clip_program();
  for (const ComputeModel& model : models_) {
    if (model.level_count() > 1) make_spread_program();
    make_form_programs(static_cast<int>(model.model->model.kernel.form), lit);
  }
}

void ComputeTier::set_streaming(const Scene& scene, std::uint32_t fade_updates) {
  make_light_programs();
  make_clip_program();
  make_spread_program();
  make_pose_programs();
  for (int form = 0; form < kernel_form_count; ++form) make_form_programs(form, true);
  ComputeScene* placed = placed_scene(scenes_, scene);
  if (!placed) placed = &scenes_.emplace_back(device_, scene);
  placed->begin_streaming(fade_updates);
}

bool ComputeTier::is_streaming(const Scene& scene) const {
  const ComputeScene* const placed = placed_scene(scenes_, scene);
  return placed && placed->streaming.is_used;
}

StreamLeft ComputeTier::prepare_within(const Scene& scene, const Budget& budget) {
  const Device::Unchecked unchecked(device_);
  ComputeScene& placed = *placed_scene(scenes_, scene);
  placed.follow_edits(device_);
  placed.drop_unused_within(models_, budget);
  placed.place_within(device_, models_, budget);
  placed.place_clips(device_, budget);
  return {placed.count_pending(), placed.streaming.has_new_views};
}

void ComputeTier::prepare(const Scene& scene) {
  ComputeScene* placed = placed_scene(scenes_, scene);
  if (placed && placed->streaming.is_used) {
    prepare_within(scene, Budget::unlimited());
    return;
  }
  if (!placed) placed = &scenes_.emplace_back(device_, scene);
  if (placed->outdated()) {
    device_.report_host_errors();
    placed->place_all(device_, models_);
    placed->make_buffers(device_);
    device_.check("preparing a scene");
    if (placed->table.is_used()) placed->make_table(device_);
    placed->finish();
    placed->write_table(device_);
  }
  placed->place_clips(device_, Budget::unlimited());
  make_programs(*placed);
}

void ComputeTier::update(Scene& scene) {
  ComputeScene& placed = *placed_scene(scenes_, scene);
  std::optional<Device::Unchecked> unchecked;
  if (placed.streaming.is_used) {
    unchecked.emplace(device_);
    placed.follow_edits(device_);
    placed.evaluate_fading();
  }
  const PendingMarks marks(placed, scene);
  decide(device_, placed, scene);
  placed.lights.upload(device_, scene);
  if (upload_frame(device_, placed)) run({placed, scene.settings.form == NOOK_FORM_DEFAULT});
  remember_update(placed, scene);
  if (placed.streaming.is_used) placed.finish_streamed(scene);
  placed.finish_assigned(scene);
  placed.write_table(device_);
  count_update(placed, scene);
}

VertexValues ComputeTier::place(const Scene& scene, nook_instance_id instance) const {
  const ComputeScene* placed = placed_scene(scenes_, scene);
  if (!placed) fail_without_place(instance);
  return scene.pool.is_used() || placed->streaming.is_used ? pooled_view(scene, instance).values
                                                           : placed->place(instance);
}

PooledView ComputeTier::pooled_view(const Scene& scene, nook_instance_id instance) const {
  const ComputeScene* placed = placed_scene(scenes_, scene);
  if (!placed) fail_without_place(instance);
  return placed->streaming.is_used ? placed->streamed_view(instance) : placed->pooled_view(instance);
}

PoolCount ComputeTier::pool_count(const Scene& scene) const {
  const ComputeScene* placed = placed_scene(scenes_, scene);
  return placed ? placed->pool_count : PoolCount{};
}

PoolTablePlace ComputeTier::pool_table(const Scene& scene, const LoadedModel& model,
                                       std::span<GLuint> ao_buffers) {
  ComputeScene& placed = *placed_scene(scenes_, scene);
  placed.make_table(device_);
  placed.write_table(device_);
  PoolTablePlace place{placed.table.name(), placed.table.size(), 0};
  for (const ComputeChunk& chunk : placed.chunks) {
    if (chunk.model->model.get() != &model) continue;
    if (place.ao_buffers < ao_buffers.size()) ao_buffers[place.ao_buffers] = chunk.ao.name();
    ++place.ao_buffers;
  }
  return place;
}

LightPlace ComputeTier::light_place(const Scene& scene, nook_instance_id instance) const {
  const ComputeScene* placed = placed_scene(scenes_, scene);
  if (!placed) fail_without_light(instance);
  return placed->light_place(instance);
}

void ComputeTier::read(const VertexValues& values, float* out) const {
  read_buffer(device_, values, out);
}

ModelMemory ComputeTier::memory_of(const LoadedModel& model) const {
  return compute_memory(model);
}

void ComputeTier::release(const Scene& scene) {
  scenes_.remove_if([&](const ComputeScene& placed) { return placed.scene == &scene; });
  drop_unused(models_);
}

// Runs each pass for all chunks before it runs the next pass, because the casters of an instance may be in
// any chunk. One barrier after each pass is then enough.
void ComputeTier::run(const Update& update) const {
  const Functions& gl = device_.gl;
  place_poses(update);
  decode_clips(update);
  run_spheres(update);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  run_shadows(update);
  run_colours(update);
  gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  if (spread_.name()) {
    run_spread(update);
    run_colours_spread(update);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
  run_vertices(update);
  run_lit_vertices(update);
  gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                   GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ComputeTier::run_spheres(const Update& update) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(spheres_.name());
  bind_whole(gl, NOOK_BINDING_SPHERES, update.placed.spheres);
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.selected == 0) continue;
    bind_stream(gl, update.placed, chunk);
    bind_whole(gl, NOOK_BINDING_MODEL, chunk.model->spheres_rest);
    gl.Uniform1ui(NOOK_LOCATION_SPHERES_COUNT, chunk.model->spheres());
    gl.DispatchCompute(groups(chunk.model->spheres(), NOOK_GROUP_SIZE), chunk.frame.selected, 1);
  }
}

// Binds the buffers of a pass over key points, and dispatches the pass for the instances of a chunk that are
// due.
void ComputeTier::run_key_points(const Update& update, const ComputeChunk& chunk) const {
  const Functions& gl = device_.gl;
  const ComputeModel& model = *chunk.model;
  bind_stream(gl, update.placed, chunk);
  bind_whole(gl, NOOK_BINDING_SPHERES, update.placed.spheres);
  bind_whole(gl, NOOK_BINDING_MODEL, model.key_points_rest);
  gl.Uniform1f(NOOK_LOCATION_GAMMA, model.model->model.kernel.gamma);
  gl.Uniform1i(NOOK_LOCATION_COMPOSED, update.composed);
  gl.Uniform1ui(NOOK_LOCATION_SHADOW_STRIDE, model.shadows());
  std::uint32_t first = 0;
  for (std::uint32_t l = 0; l < model.level_count(); ++l) {
    const std::uint32_t count = chunk.frame.due_at_level[l];
    if (count == 0) continue;
    const LevelRange& level = model.levels[l];
    gl.Uniform1ui(NOOK_LOCATION_FIRST_RECORD, first);
    gl.Uniform1ui(NOOK_LOCATION_FIRST_SPHERE, level.first_sphere);
    gl.Uniform1ui(NOOK_LOCATION_SPHERE_COUNT, level.spheres);
    gl.Uniform1ui(NOOK_LOCATION_FIRST_KEY_POINT, level.first_key_point);
    gl.Uniform1ui(NOOK_LOCATION_KEY_POINT_COUNT, level.key_points);
    gl.Uniform1ui(NOOK_LOCATION_SHADOW_OFFSET, l == 0 ? 0 : model.key_points());
    gl.DispatchCompute(groups(level.key_points, NOOK_GROUP_SIZE), count, 1);
    first += count;
  }
}

void ComputeTier::run_shadows(const Update& update) const {
  const Functions& gl = device_.gl;
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.due == 0) continue;
    gl.UseProgram(shadows_[static_cast<int>(chunk.model->model->model.kernel.form)].name());
    bind_whole(gl, NOOK_BINDING_KEY_POINTS, chunk.shadows);
    run_key_points(update, chunk);
  }
}

void ComputeTier::run_colours(const Update& update) const {
  const Functions& gl = device_.gl;
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.lit == 0) continue;
    gl.UseProgram(colours_[static_cast<int>(chunk.model->model->model.kernel.form)].name());
    bind_whole(gl, NOOK_BINDING_KEY_POINTS, chunk.colours);
    run_key_points(update, chunk);
  }
}

void ComputeTier::spread_levels(const Update& update, const ComputeChunk& chunk) const {
  const Functions& gl = device_.gl;
  const ComputeModel& model = *chunk.model;
  bind_stream(gl, update.placed, chunk);
  bind_whole(gl, NOOK_BINDING_MODEL, model.spread);
  gl.Uniform1ui(NOOK_LOCATION_SPREAD_KEY_POINT_COUNT, model.key_points());
  gl.Uniform1ui(NOOK_LOCATION_SPREAD_SHADOW_STRIDE, model.shadows());
  std::uint32_t first = chunk.frame.due_at_level[0];
  for (std::uint32_t l = 1; l < model.level_count(); ++l) {
    const std::uint32_t count = chunk.frame.due_at_level[l];
    if (count == 0) continue;
    gl.Uniform1ui(NOOK_LOCATION_SPREAD_FIRST_RECORD, first);
    gl.Uniform1ui(NOOK_LOCATION_SPREAD_LEVEL, l - 1);
    gl.DispatchCompute(groups(model.key_points(), NOOK_GROUP_SIZE), count, 1);
    first += count;
  }
}

void ComputeTier::run_spread(const Update& update) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(spread_.name());
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.due == chunk.frame.due_at_level[0]) continue;
    bind_whole(gl, NOOK_BINDING_KEY_POINTS, chunk.shadows);
    spread_levels(update, chunk);
  }
}

void ComputeTier::run_colours_spread(const Update& update) const {
  const Functions& gl = device_.gl;
  if (colours_spread_.name()) gl.UseProgram(colours_spread_.name());
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.lit == 0 || chunk.frame.due == chunk.frame.due_at_level[0]) continue;
    bind_whole(gl, NOOK_BINDING_KEY_POINTS, chunk.colours);
    spread_levels(update, chunk);
  }
}

void ComputeTier::blend_vertices(const Update& update, const ComputeChunk& chunk, const Buffer& key_points,
                                 const Buffer& out) const {
  const Functions& gl = device_.gl;
  const ComputeModel& model = *chunk.model;
  bind_stream(gl, update.placed, chunk);
  bind_whole(gl, NOOK_BINDING_VERTEX_INPUT, key_points);
  bind_whole(gl, NOOK_BINDING_MODEL, model.linear);
  bind_whole(gl, NOOK_BINDING_AO, out);
  gl.Uniform1ui(NOOK_LOCATION_FILE_VERTEX_COUNT, model.file_vertices());
  gl.Uniform1ui(NOOK_LOCATION_VERTEX_COUNT, model.vertices());
  gl.Uniform1ui(NOOK_LOCATION_INFLUENCE_PAIRS, model.influence_pairs());
  gl.Uniform1ui(NOOK_LOCATION_VERTEX_SHADOW_STRIDE, model.shadows());
  gl.DispatchCompute(groups(model.file_vertices(), NOOK_VERTEX_GROUP_SIZE), chunk.frame.due, 1);
}

void ComputeTier::run_vertices(const Update& update) const {
  device_.gl.UseProgram(vertices_.name());
  for (const ComputeChunk& chunk : update.placed.chunks)
    if (chunk.frame.due) blend_vertices(update, chunk, chunk.shadows, chunk.ao);
}

// If one instance of a chunk has a light, runs the pass for all instances of the chunk. The instances without
// a light get their AO in all channels.
void ComputeTier::run_lit_vertices(const Update& update) const {
  const Functions& gl = device_.gl;
  for (const ComputeChunk& chunk : update.placed.chunks) {
    if (chunk.frame.lit == 0) continue;
    gl.UseProgram(lit_vertices_.name());
    blend_vertices(update, chunk, chunk.colours, chunk.directional_ao);
    if (chunk.frame.lit == chunk.frame.due) continue;
    gl.UseProgram(grey_vertices_.name());
    blend_vertices(update, chunk, chunk.shadows, chunk.directional_ao);
  }
}

}  // namespace nook::gl
