#include "sdk/src/gl/character/compute_tier.h"

#include <bit>
#include <cstdio>

#include "sdk/src/gl/character/frame_stream.h"
#include "sdk/src/gl/character/scene_lights.h"
#include "sdk/src/gl/program.h"

namespace nook::gl {
namespace {

// Bindings of the shader storage blocks, as shaders/character/ has them.
enum Binding : GLuint {
  binding_records = 0,
  binding_bones = 1,
  binding_casters = 2,
  binding_spheres = 3,
  binding_weights = 4,
  binding_shadows = 5,
  binding_model = 6,
  binding_ao = 7,
  // Of the passes over lights.
  binding_colours = 5,
  binding_lights = 7,
  binding_vertex_colours = 3,
};

constexpr std::uint32_t groups(std::uint32_t threads, std::uint32_t group_size) {
  return (threads + group_size - 1) / group_size;
}

void bind_whole(const Functions& gl, GLuint binding, const Buffer& buffer) {
  gl.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
}

void bind_piece(const Functions& gl, GLuint binding, const Buffer& buffer, std::uint64_t offset,
                std::uint64_t bytes) {
  gl.BindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, buffer.name(), static_cast<GLintptr>(offset),
                     static_cast<GLsizeiptr>(bytes));
}

void bind_poses(const Functions& gl, const SceneBuffers& buffers, const Chunk& chunk) {
  const Chunk::Frame& frame = chunk.frame;
  bind_piece(gl, binding_records, buffers.stream, frame.records, frame.selected * sizeof(InstanceRecord));
  bind_piece(gl, binding_bones, buffers.stream, frame.bones,
             std::uint64_t{frame.selected} * chunk.model->bones() * sizeof(Mat3x4));
}

bool uses_self(const Scene& scene) {
  return (scene.terms & NOOK_TERM_SELF) != 0;
}

// The GPU's own record of who was evaluated stands in for the CPU's while the scene decides who is due.
void resolve_for_gpu(SceneBuffers& buffers, Scene& scene) {
  const auto exchange = [&] {
    for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot)
      std::swap(scene.instances[slot].evaluated_frame, buffers.placements[slot].evaluated_frame);
  };
  ++scene.frame;
  exchange();
  resolve_casters(scene);
  exchange();
  // Should the upload fail, the next update makes up for this one.
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot)
    if (scene.instances[slot].due) buffers.placements[slot].evaluated_frame = 0;
}

std::uint64_t count_evaluations(const SceneBuffers& buffers, const Scene& scene, std::uint32_t slot) {
  const Instance& instance = scene.instances[slot];
  const auto level_of = [&](std::uint32_t of) -> const LevelRange& {
    return buffers.placements[of].chunk->model->level(instance.level);
  };
  std::uint64_t spheres = (scene.terms & NOOK_TERM_SELF ? level_of(slot).spheres : 0) +
                          instance.occluders.size() + (instance.ground_sphere.radius > 0);
  for (const std::uint32_t caster : instance.casters) spheres += level_of(caster).spheres;
  return spheres * level_of(slot).key_points;
}

void count_update(const SceneBuffers& buffers, Scene& scene) {
  scene.stats = {};
  scene.stats.instances = scene.living;
  for (std::uint32_t slot = 0; slot < scene.instances.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    if (instance.id == 0 || !instance.due) continue;
    ++scene.stats.instances_updated;
    scene.stats.links += static_cast<std::uint32_t>(instance.casters.size());
    scene.stats.links_culled += instance.culled;
    scene.stats.evaluations += count_evaluations(buffers, scene, slot);
  }
}

void remember_update(SceneBuffers& buffers, const Scene& scene) {
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot) {
    const Instance& instance = scene.instances[slot];
    Placement& placement = buffers.placements[slot];
    if (instance.id == 0) continue;
    if (instance.due) placement.evaluated_frame = scene.frame;
    placement.transformed_revision = instance.pose_revision;
  }
}

}  // namespace

ComputeTier::ComputeTier(Device& device)
    : device_(device),
      spheres_(compute_program(device, "character/spheres.comp", "")),
      vertices_(compute_program(device, "character/vertices.comp", "#define NOOK_LIGHT 0\n")) {}

void ComputeTier::prepare(const ModelList& models, const SceneBuffers& buffers) {
  const bool lit = buffers.lights.name() != 0;
  if (lit && lit_vertices_.name() == 0) {
    lit_vertices_ = compute_program(device_, "character/vertices.comp", "#define NOOK_LIGHT 1\n");
    colours_spread_ = compute_program(device_, "character/colours_spread.comp", "");
  }
  for (const ModelBuffers& model : models) {
    if (model.level_count() > 1 && spread_.name() == 0)
      spread_ = compute_program(device_, "character/spread.comp", "");
    const auto form = static_cast<int>(model.model->model.kernel.form);
    char defines[40];
    std::snprintf(defines, sizeof defines, "#define NOOK_KERNEL_FORM %d\n", form);
    if (shadows_[form].name() == 0)
      shadows_[form] = compute_program(device_, "character/shadows.comp", defines);
    if (lit && colours_[form].name() == 0)
      colours_[form] = compute_program(device_, "character/colours.comp", defines);
  }
}

// Each pass runs for all chunks before the next one, since casters may live in any chunk, and so that one
// barrier serves all.
void ComputeTier::update(SceneBuffers& buffers, Scene& scene) const {
  const Functions& gl = device_.gl;
  notice_lights(buffers, scene);
  resolve_for_gpu(buffers, scene);
  for (Instance& instance : scene.instances)
    if (instance.light.count > 0 && instance.due) prepare_light(scene, instance);
  upload_lights(device_, buffers, scene);
  if (upload_frame(device_, buffers, scene)) {
    run_spheres(buffers);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    run_shadows(buffers, scene);
    run_colours(buffers, scene);
    gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    if (spread_.name()) {
      run_spread(buffers, scene);
      run_colours_spread(buffers);
      gl.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    run_vertices(buffers, scene);
    run_lit_vertices(buffers, scene);
    gl.MemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                     GL_TEXTURE_FETCH_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  }
  remember_update(buffers, scene);
  count_update(buffers, scene);
}

// The locations of uniforms are fixed in the shaders.
void ComputeTier::run_spheres(const SceneBuffers& buffers) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(spheres_.name());
  bind_whole(gl, binding_spheres, buffers.spheres);
  bind_whole(gl, binding_weights, buffers.caster_weights);
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.selected == 0) continue;
    bind_poses(gl, buffers, chunk);
    bind_whole(gl, binding_model, chunk.model->spheres_rest);
    gl.Uniform1ui(0, chunk.model->spheres());
    gl.DispatchCompute(groups(chunk.model->spheres(), 64), chunk.frame.selected, 1);
  }
}

// Binds and dispatches a pass over key points for the instances of a chunk that are due.
void ComputeTier::run_key_points(const SceneBuffers& buffers, const Scene& scene, const Chunk& chunk) const {
  const Functions& gl = device_.gl;
  const ModelBuffers& model = *chunk.model;
  bind_poses(gl, buffers, chunk);
  bind_piece(gl, binding_casters, buffers.stream, chunk.frame.casters, chunk.frame.caster_bytes);
  bind_whole(gl, binding_model, model.key_points_rest);
  gl.Uniform1f(5, model.model->model.kernel.gamma);
  gl.Uniform1i(6, uses_self(scene));
  gl.Uniform1i(7, scene.settings.combine == NOOK_COMBINE_COMPOSED);
  gl.Uniform1ui(8, model.shadows());
  std::uint32_t first = 0;
  for (std::uint32_t l = 0; l < model.level_count(); ++l) {
    const std::uint32_t count = chunk.frame.due_at_level[l];
    if (count == 0) continue;
    const LevelRange& level = model.levels[l];
    gl.Uniform1ui(0, first);
    gl.Uniform1ui(1, level.first_sphere);
    gl.Uniform1ui(2, level.spheres);
    gl.Uniform1ui(3, level.first_key_point);
    gl.Uniform1ui(4, level.key_points);
    gl.Uniform1ui(9, l == 0 ? 0 : model.key_points());
    gl.DispatchCompute(groups(level.key_points, 64), count, 1);
    first += count;
  }
}

void ComputeTier::run_shadows(const SceneBuffers& buffers, const Scene& scene) const {
  const Functions& gl = device_.gl;
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.due == 0) continue;
    gl.UseProgram(shadows_[static_cast<int>(chunk.model->model->model.kernel.form)].name());
    bind_whole(gl, binding_shadows, chunk.shadows);
    run_key_points(buffers, scene, chunk);
  }
}

void ComputeTier::run_colours(const SceneBuffers& buffers, const Scene& scene) const {
  const Functions& gl = device_.gl;
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.lit == 0) continue;
    gl.UseProgram(colours_[static_cast<int>(chunk.model->model->model.kernel.form)].name());
    bind_whole(gl, binding_colours, chunk.colours);
    bind_whole(gl, binding_lights, buffers.lights);
    run_key_points(buffers, scene, chunk);
  }
}

void ComputeTier::spread_levels(const SceneBuffers& buffers, const Chunk& chunk) const {
  const Functions& gl = device_.gl;
  const ModelBuffers& model = *chunk.model;
  bind_poses(gl, buffers, chunk);
  bind_whole(gl, binding_model, model.spread);
  gl.Uniform1ui(1, model.key_points());
  gl.Uniform1ui(2, model.shadows());
  std::uint32_t first = chunk.frame.due_at_level[0];
  for (std::uint32_t l = 1; l < model.level_count(); ++l) {
    const std::uint32_t count = chunk.frame.due_at_level[l];
    if (count == 0) continue;
    gl.Uniform1ui(0, first);
    gl.Uniform1ui(4, l - 1);
    gl.DispatchCompute(groups(model.key_points(), 64), count, 1);
    first += count;
  }
}

void ComputeTier::run_spread(const SceneBuffers& buffers, const Scene& scene) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(spread_.name());
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.due == chunk.frame.due_at_level[0]) continue;
    bind_whole(gl, binding_shadows, chunk.shadows);
    gl.Uniform1i(3, uses_self(scene));
    spread_levels(buffers, chunk);
  }
}

void ComputeTier::run_colours_spread(const SceneBuffers& buffers) const {
  const Functions& gl = device_.gl;
  if (colours_spread_.name()) gl.UseProgram(colours_spread_.name());
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.lit == 0 || chunk.frame.due == chunk.frame.due_at_level[0]) continue;
    bind_whole(gl, binding_colours, chunk.colours);
    spread_levels(buffers, chunk);
  }
}

void ComputeTier::blend_vertices(const SceneBuffers& buffers, const Scene& scene, const Chunk& chunk,
                                 const Buffer& out) const {
  const Functions& gl = device_.gl;
  const ModelBuffers& model = *chunk.model;
  bind_poses(gl, buffers, chunk);
  bind_whole(gl, binding_shadows, chunk.shadows);
  bind_whole(gl, binding_model, model.linear);
  bind_whole(gl, binding_ao, out);
  gl.Uniform1ui(0, model.file_vertices());
  gl.Uniform1ui(1, model.vertices());
  gl.Uniform1ui(2, model.influence_pairs());
  gl.Uniform1ui(3, model.shadows());
  gl.Uniform1i(4, uses_self(scene));
  gl.DispatchCompute(groups(model.file_vertices(), 128), chunk.frame.due, 1);
}

void ComputeTier::run_vertices(const SceneBuffers& buffers, const Scene& scene) const {
  device_.gl.UseProgram(vertices_.name());
  for (const Chunk& chunk : buffers.chunks)
    if (chunk.frame.due) blend_vertices(buffers, scene, chunk, chunk.ao);
}

// For all instances of a chunk where one has a light: the others get AO in all channels.
void ComputeTier::run_lit_vertices(const SceneBuffers& buffers, const Scene& scene) const {
  const Functions& gl = device_.gl;
  if (lit_vertices_.name()) gl.UseProgram(lit_vertices_.name());
  for (const Chunk& chunk : buffers.chunks) {
    if (chunk.frame.lit == 0) continue;
    bind_whole(gl, binding_vertex_colours, chunk.colours);
    blend_vertices(buffers, scene, chunk, chunk.directional_ao);
  }
}

}  // namespace nook::gl
