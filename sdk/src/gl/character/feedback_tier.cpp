#include "sdk/src/gl/character/feedback_tier.h"

#include <cstdio>
#include <optional>

#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/instance_views.h"
#include "sdk/src/gl/character/pending_marks.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"
#include "shaders/character/layout.h"

namespace nook::gl {
namespace {

static_assert(CharacterModel::max_influences <= 8,
              "vertices.vert has attributes for two quads of influences");

// A page with two floats for each key point: shadow and added occlusion.
struct Shadows {
  static constexpr std::uint32_t floats = 2, texels = 1;
  static void write(const Scene& scene, const Instance& instance, float* out) {
    const PointLanes& points = instance.arrays().points;
    const bool composed = scene.settings.form == NOOK_FORM_DEFAULT;
    for (std::uint32_t k = 0; k < points.count; ++k) {
      *out++ = points.shadow[k];
      *out++ = composed ? points.added[k] : 0.0f;
    }
  }
};

// A page with eight floats for each key point: shadow and added occlusion of each channel. For an instance
// without a light, all channels are equal.
struct Colours {
  static constexpr std::uint32_t floats = 8, texels = NOOK_COLOUR_VEC4S;
  static void write(const Scene& scene, const Instance& instance, float* out) {
    const PointLanes& points = instance.arrays().points;
    const InstanceLight& light = instance.light();
    const bool composed = scene.settings.form == NOOK_FORM_DEFAULT;
    for (std::uint32_t k = 0; k < points.count; ++k, out += floats) {
      for (int c = 0; c < 3; ++c) {
        out[c] = light.evaluated ? light.shadow[c][k] : points.shadow[k];
        out[4 + c] = !composed ? 0.0f : light.evaluated ? light.added[c][k] : points.added[k];
      }
      out[3] = points.shadow[k];
      out[7] = 0;
    }
  }
};

// Fills the page with the key points of waiting instances, in the order of their places. Starts at the place
// `first` and stops when the page is full. Returns the place at which the next page begins, or `first` if no
// instance is waiting.
template <class Kind>
std::uint32_t fill_page(Device& device, const FeedbackScene& placed, TexelTable& page,
                        const FeedbackChunk& chunk, std::uint32_t first) {
  const std::uint64_t instance_floats = std::uint64_t{chunk.model->key_points()} * Kind::floats;
  const std::uint64_t instance_texels = std::uint64_t{chunk.model->key_points()} * Kind::texels;
  const std::uint64_t max = page.capacity() / instance_texels;
  std::uint32_t end = first;
  std::uint64_t count = 0;
  for (; end < chunk.capacity && count < max; ++end) count += placed.waits(chunk, end);
  if (count == 0) return first;
  page.write(device, count * instance_texels, [&](void* memory) {
    auto* out = static_cast<float*>(memory);
    for (std::uint32_t place = first; place < end; ++place) {
      if (!placed.waits(chunk, place)) continue;
      Kind::write(*placed.scene, placed.scene->instances[chunk.slots[place]], out);
      out += instance_floats;
    }
  });
  return end;
}

}  // namespace

FeedbackTier::FeedbackTier(Device& device)
    : device_(device), target_(device), models_(device.memory), scenes_(device.memory) {
  for (int quads = 1; quads <= 2; ++quads) {
    programs_[quads - 1] = make_program(quads, false);
    lit_programs_[quads - 1] = make_program(quads, true);
  }
}

FeedbackTier::Program FeedbackTier::make_program(int quads, bool lit) {
  char defines[64];
  std::snprintf(defines, sizeof defines, "#define NOOK_QUADS %d\n#define NOOK_LIGHT %d\n", quads, int(lit));
  Program program;
  program.object =
      feedback_program(device_, "character/vertices.vert", defines, lit ? "nook_directional_ao" : "nook_ao");
  program.first_key_point = uniform_location(device_, program.object, "nook_first_key_point");
  program.key_point_count = uniform_location(device_, program.object, "nook_key_point_count");
  program.self = uniform_location(device_, program.object, "nook_self");
  program.hidden = uniform_location(device_, program.object, "nook_hidden");
  device_.gl.UseProgram(program.object.name());
  device_.gl.Uniform1i(uniform_location(device_, program.object, "nook_shadows"), 0);
  return program;
}

void FeedbackTier::set_streaming(const Scene& scene, std::uint32_t fade_updates) {
  FeedbackScene* placed = placed_scene(scenes_, scene);
  if (!placed) placed = &scenes_.emplace_back(device_, scene);
  placed->begin_streaming(fade_updates);
}

bool FeedbackTier::is_streaming(const Scene& scene) const {
  const FeedbackScene* const placed = placed_scene(scenes_, scene);
  return placed && placed->streaming.is_used;
}

StreamLeft FeedbackTier::prepare_within(const Scene& scene, const Budget& budget) {
  const Device::Unchecked unchecked(device_);
  FeedbackScene& placed = *placed_scene(scenes_, scene);
  placed.follow_edits(device_);
  placed.drop_unused_within(models_, budget);
  placed.place_within(device_, models_, budget);
  return {placed.streaming.pending, placed.streaming.has_new_views};
}

void FeedbackTier::prepare(const Scene& scene) {
  FeedbackScene* placed = placed_scene(scenes_, scene);
  if (placed && placed->streaming.is_used) {
    prepare_within(scene, Budget::unlimited());
    return;
  }
  if (!placed) placed = &scenes_.emplace_back(device_, scene);
  if (!placed->outdated()) return;
  device_.report_host_errors();
  placed->place_all(device_, models_);
  placed->make_buffers(device_);
  device_.check("preparing a scene");
  placed->finish();
}

namespace {

[[noreturn]] void fail_without_compute() {
  throw Failure(
      NOOK_ERROR_UNSUPPORTED,
      "poses on the GPU need compute shaders (OpenGL 4.3 or OpenGL ES 3.1), which this context does "
      "not have; play baked clips (nook_scene_set_clip), or call nook_scene_set_pose");
}

}  // namespace

void FeedbackTier::set_poses(Scene&, const PoseBatch&) {
  fail_without_compute();
}

void FeedbackTier::read_pose(const Scene&, nook_instance_id, std::span<Mat3x4>) const {
  fail_without_compute();
}

void FeedbackTier::update(Scene& scene) {
  need_cpu_poses(scene);
  FeedbackScene& placed = *placed_scene(scenes_, scene);
  std::optional<Device::Unchecked> unchecked;
  if (placed.streaming.is_used) {
    unchecked.emplace(device_);
    placed.follow_edits(device_);
    placed.evaluate_fading();
  }
  const PendingMarks marks(placed, scene);
  placed.notice_lights();
  if (placed.streaming.is_used && placed.lacks_light_buffers()) placed.make_light_buffers(device_);
  nook::update(scene);
  // A pending instance is not due, but the host's shader reads its light.
  if (placed.streaming.is_used)
    for (Instance& instance : scene.instances)
      if (instance.plan.is_far && instance.light().count > 0) prepare_light(scene, instance);
  // If an upload fails, the next update uploads these instances again.
  for (std::size_t slot = 0; slot < placed.placements.size(); ++slot)
    placed.placements[slot].evaluated &= !scene.instances[slot].plan.due;
  placed.lights.upload(device_, scene);
  draw_scene(placed);
  if (placed.streaming.is_used) placed.finish_streamed(scene);
}

VertexValues FeedbackTier::place(const Scene& scene, nook_instance_id instance) const {
  const FeedbackScene* placed = placed_scene(scenes_, scene);
  if (!placed) fail_without_place(instance);
  return placed->streaming.is_used ? placed->streamed_view(instance).values : placed->place(instance);
}

// prepare refuses a scene with a pool.
PooledView FeedbackTier::pooled_view(const Scene& scene, nook_instance_id instance) const {
  const FeedbackScene* placed = placed_scene(scenes_, scene);
  if (!placed || !placed->streaming.is_used) fail_without_place(instance);
  return placed->streamed_view(instance);
}

PoolCount FeedbackTier::pool_count(const Scene&) const {
  return {};
}

PoolTablePlace FeedbackTier::pool_table(const Scene&, const LoadedModel&, std::span<GLuint>) {
  return {};
}

LightPlace FeedbackTier::light_place(const Scene& scene, nook_instance_id instance) const {
  const FeedbackScene* placed = placed_scene(scenes_, scene);
  if (!placed) fail_without_light(instance);
  return placed->light_place(instance);
}

void FeedbackTier::read(const VertexValues& values, float* out) const {
  read_buffer(device_, values, out);
}

ModelMemory FeedbackTier::memory_of(const LoadedModel& model) const {
  return feedback_memory(model, device_.gl.can.indexed_feedback);
}

void FeedbackTier::release(const Scene& scene) {
  scenes_.remove_if([&](const FeedbackScene& placed) { return placed.scene == &scene; });
  drop_unused(models_);
}

void FeedbackTier::draw_scene(FeedbackScene& placed) const {
  const Functions& gl = device_.gl;
  target_.begin(device_);
  // WebGL does not allow transform feedback into a buffer that is also bound to another binding point.
  gl.BindBuffer(GL_ARRAY_BUFFER, 0);
  gl.ActiveTexture(GL_TEXTURE0);
  for (const FeedbackChunk& chunk : placed.chunks) {
    draw_chunk<Shadows>(placed, chunk, {programs_, &placed.shadows, &chunk.ao, 1});
    if (chunk.directional_ao.name())
      draw_chunk<Colours>(placed, chunk, {lit_programs_, &placed.colours, &chunk.directional_ao, 3});
    for (const std::uint32_t slot : chunk.slots)
      if (slot != FeedbackChunk::empty) placed.placements[slot].evaluated = true;
  }
  FeedbackTarget::end(device_);
}

template <class Kind>
void FeedbackTier::draw_chunk(const FeedbackScene& placed, const FeedbackChunk& chunk,
                              const Target& target) const {
  const Program& program = target.programs[chunk.model->influence_quads() - 1];
  target.page->bind(device_);
  device_.gl.UseProgram(program.object.name());
  device_.gl.Uniform1i(program.key_point_count, static_cast<GLint>(chunk.model->key_points()));
  device_.gl.BindVertexArray(chunk.model->vertex_array.name());
  std::uint32_t first = 0, end;
  while ((end = fill_page<Kind>(device_, placed, *target.page, chunk, first)) > first) {
    draw_page(placed, chunk, first, end, program, target);
    first = end;
  }
}

// Instances at consecutive places are also consecutive in the page. One draw handles a run of such instances
// if all of them have self-shadow, or if none has, and if they are equally hidden.
void FeedbackTier::draw_page(const FeedbackScene& placed, const FeedbackChunk& chunk, std::uint32_t first,
                             std::uint32_t end, const Program& program, const Target& target) const {
  const auto has_self = [&](std::uint32_t place) {
    return has_self_shadow(*placed.scene, placed.scene->instances[chunk.slots[place]]);
  };
  const auto hidden_steps = [&](std::uint32_t place) { return placed.hidden_steps(chunk.slots[place]); };
  std::uint32_t drawn = 0;
  while (first < end) {
    if (!placed.waits(chunk, first)) {
      ++first;
      continue;
    }
    const bool self = has_self(first);
    const std::uint32_t hidden = hidden_steps(first);
    std::uint32_t run_end = first + 1;
    while (run_end < end && placed.waits(chunk, run_end) && has_self(run_end) == self &&
           hidden_steps(run_end) == hidden)
      ++run_end;
    device_.gl.Uniform1i(program.self, self);
    device_.gl.Uniform1f(program.hidden, static_cast<float>(hidden) / static_cast<float>(NOOK_HIDDEN_STEPS));
    device_.gl.Uniform1i(program.first_key_point, static_cast<GLint>(drawn * chunk.model->key_points()));
    draw(chunk, first, run_end, target);
    drawn += run_end - first;
    first = run_end;
  }
}

void FeedbackTier::draw(const FeedbackChunk& chunk, std::uint32_t first, std::uint32_t end,
                        const Target& target) const {
  const Functions& gl = device_.gl;
  const std::uint32_t vertices = chunk.model->file_vertices();
  const std::uint64_t instance_bytes = std::uint64_t{vertices} * target.channels * sizeof(float);
  gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, target.out->name(),
                     static_cast<GLintptr>(first * instance_bytes),
                     static_cast<GLsizeiptr>((end - first) * instance_bytes));
  gl.BeginTransformFeedback(GL_POINTS);
  if (gl.can.indexed_feedback)
    gl.DrawElementsInstanced(GL_POINTS, static_cast<GLsizei>(vertices), GL_UNSIGNED_INT, nullptr,
                             static_cast<GLsizei>(end - first));
  else
    gl.DrawArraysInstanced(GL_POINTS, 0, static_cast<GLsizei>(vertices), static_cast<GLsizei>(end - first));
  gl.EndTransformFeedback();
}

}  // namespace nook::gl
