#include "gl/character/feedback_tier.h"

#include <algorithm>

#include "core/failure.h"
#include "gl/program.h"

namespace nook::gl {
namespace {

static_assert(CharacterModel::max_influences <= 8,
              "vertices.vert has attributes for two quads of influences");

bool wanted(const SceneBuffers& buffers, const Chunk& chunk, std::uint32_t place) {
  const std::uint32_t slot = chunk.slots[place];
  return slot != Chunk::empty && !buffers.placements[slot].evaluated;
}

void write_shadows(const Scene& scene, const Instance& instance, float* out) {
  const PointLanes& points = instance.arrays.points;
  const bool composed = scene.settings.combine == NOOK_COMBINE_COMPOSED;
  for (std::uint32_t k = 0; k < points.count; ++k) {
    *out++ = points.shadow[k];
    *out++ = composed ? points.added[k] : 0.0f;
  }
}

// Sends the shadows of the wanted places from `first` on, in their order and as many as fit; returns the end
// of these places, or `first` if none is left.
std::uint32_t fill_page(SceneBuffers& buffers, const Scene& scene, const Chunk& chunk, std::uint32_t first) {
  const std::uint64_t instance_bytes = std::uint64_t{chunk.model->key_points()} * 2 * sizeof(float);
  const std::uint64_t most = buffers.page.bytes() / instance_bytes;
  std::uint32_t end = first;
  std::uint64_t count = 0;
  for (; end < chunk.capacity && count < most; ++end) count += wanted(buffers, chunk, end);
  if (count == 0) return first;
  auto* memory = static_cast<float*>(buffers.page.begin_write(count * instance_bytes));
  for (std::uint32_t place = first; place < end; ++place) {
    if (!wanted(buffers, chunk, place)) continue;
    write_shadows(scene, scene.instances[chunk.slots[place]], memory);
    memory += instance_bytes / sizeof(float);
  }
  buffers.page.end_write();
  return end;
}

}  // namespace

FeedbackTier::FeedbackTier(Device& device) : device_(device) {
  const Functions& gl = device.gl;
  const char* defines[] = {"#define NOOK_QUADS 1\n", "#define NOOK_QUADS 2\n"};
  for (int i = 0; i < 2; ++i) {
    Program& program = programs_[i];
    program.object = feedback_program(device, "character/vertices.vert", defines[i], "nook_ao");
    program.first_texel = uniform_location(device, program.object, "nook_first_texel");
    program.key_point_count = uniform_location(device, program.object, "nook_key_point_count");
    program.self = uniform_location(device, program.object, "nook_self");
    gl.UseProgram(program.object.name());
    gl.Uniform1i(uniform_location(device, program.object, "nook_shadows"), 0);
  }
  // A draw needs a complete framebuffer even if nothing is rasterised, and a surfaceless context has none.
  framebuffer_ = Object::make(device, Object::Kind::framebuffer);
  renderbuffer_ = Object::make(device, Object::Kind::renderbuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  gl.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                             renderbuffer_.name());
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(NOOK_ERROR_GL, "a framebuffer with an RGBA8 renderbuffer is not complete (status 0x%04x)",
                  status);
  device.label(GL_FRAMEBUFFER, framebuffer_.name(), "nook: transform feedback");
  if (gl.BindTransformFeedback && gl.GenTransformFeedbacks && gl.DeleteTransformFeedbacks)
    feedback_ = Object::make(device, Object::Kind::transform_feedback);
}

void FeedbackTier::update(SceneBuffers& buffers, Scene& scene) const {
  nook::update(scene);
  // Should an upload fail, the next update makes up for this one.
  for (std::size_t slot = 0; slot < buffers.placements.size(); ++slot)
    buffers.placements[slot].evaluated &= !scene.instances[slot].due;
  const Functions& gl = device_.gl;
  const bool self = (scene.terms & NOOK_TERM_SELF) != 0;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  if (feedback_.name()) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.name());
  gl.Enable(GL_RASTERIZER_DISCARD);
  gl.Disable(GL_PRIMITIVE_RESTART);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_BUFFER, buffers.page_texture.name());

  for (const Chunk& chunk : buffers.chunks) {
    for (std::uint32_t first = 0, end; (end = fill_page(buffers, scene, chunk, first)) > first; first = end)
      draw_page(buffers, chunk, first, end, self);
    for (const std::uint32_t slot : chunk.slots)
      if (slot != Chunk::empty) buffers.placements[slot].evaluated = true;
  }
  gl.Disable(GL_RASTERIZER_DISCARD);
}

// Neighbouring places are neighbours in the page as well, and one draw serves a whole run of them.
void FeedbackTier::draw_page(const SceneBuffers& buffers, const Chunk& chunk, std::uint32_t first,
                             std::uint32_t end, bool self) const {
  std::uint32_t drawn = 0;
  while (first < end) {
    std::uint32_t run_end = first;
    while (run_end < end && wanted(buffers, chunk, run_end)) ++run_end;
    if (run_end > first) draw(chunk, first, run_end, drawn * chunk.model->key_points(), self);
    drawn += run_end - first;
    first = run_end + 1;
  }
}

void FeedbackTier::draw(const Chunk& chunk, std::uint32_t first, std::uint32_t end, std::uint32_t texel,
                        bool self) const {
  const Functions& gl = device_.gl;
  const ModelBuffers& model = *chunk.model;
  const Program& program = programs_[model.influence_quads() - 1];
  const std::uint64_t instance_bytes = std::uint64_t{model.file_vertices()} * sizeof(float);
  gl.UseProgram(program.object.name());
  gl.Uniform1i(program.first_texel, static_cast<GLint>(texel));
  gl.Uniform1i(program.key_point_count, static_cast<GLint>(model.key_points()));
  gl.Uniform1i(program.self, self);
  gl.BindVertexArray(model.vertex_array.name());
  gl.BindBufferRange(GL_TRANSFORM_FEEDBACK_BUFFER, 0, chunk.ao.name(),
                     static_cast<GLintptr>(first * instance_bytes),
                     static_cast<GLsizeiptr>((end - first) * instance_bytes));
  gl.BeginTransformFeedback(GL_POINTS);
  gl.DrawElementsInstanced(GL_POINTS, static_cast<GLsizei>(model.file_vertices()), GL_UNSIGNED_INT, nullptr,
                           static_cast<GLsizei>(end - first));
  gl.EndTransformFeedback();
}

}  // namespace nook::gl
