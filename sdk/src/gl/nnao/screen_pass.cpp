#include "sdk/src/gl/nnao/screen_pass.h"

#include <utility>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/shader_program.h"
#include "sdk/src/gl/state_guard.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {
namespace {

// Multiplies the colours of the target by AO. Alpha is not changed.
constexpr BlendState multiplying{GL_TRUE, GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE, GL_FUNC_ADD, GL_FUNC_ADD};

static_assert(NOOK_LAYER_MIN == NOOK_GBUFFER_AO_MIN && NOOK_LAYER_REPLACE == NOOK_GBUFFER_AO_REPLACE);

}  // namespace

bool replaces_target(const NnaoFrame& frame, const nook_nnao_desc& pass) {
  const Viewport viewport = viewport_of(frame);
  const bool own = frame.target == NOOK_TARGET_OWN;
  const int width = own ? pass.max_width : frame.width, height = own ? pass.max_height : frame.height;
  return frame.blend == NOOK_BLEND_WRITE && frame.target != NOOK_TARGET_FRAMEBUFFER &&
         viewport.width == width && viewport.height == height;
}

ScreenPass::ScreenPass(Device& device, const NnaoSettings& desc) : device_(device), desc_(desc) {
  desc_.network = desc_.next = nullptr;
}

void ScreenPass::check_size() const {
  GLint largest = 0;
  device_.gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (desc_.max_width > largest || desc_.max_height > largest)
    throw Failure(
        NOOK_ERROR_UNSUPPORTED,
        "desc.max_width x desc.max_height exceeds the largest texture of this OpenGL (got %d x %d, need at "
        "most %d x %d)",
        desc_.max_width, desc_.max_height, largest, largest);
}

void ScreenPass::make_objects(const GLfloat (&open)[4]) {
  const Functions& gl = device_.gl;
  sampler_ = Object::make(device_, Object::Kind::sampler);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.SamplerParameteri(sampler_.name(), filter, GL_NEAREST);
  vertex_array_ = Object::make(device_, Object::Kind::vertex_array);
  target_framebuffer_ = Object::make(device_, Object::Kind::framebuffer);
  set_plain_drawing(gl);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, own_.framebuffer());
  for (int layer = 0; layer < drawn_layers(desc_); ++layer) {
    if (desc_.views > 0) attach_layer(gl, own_.texture(), layer);
    gl.ClearBufferfv(GL_COLOR, 0, open);
  }
}

void ScreenPass::make_stage(ScreenStage& stage, Object program, std::span<const SamplerUnit> samplers) const {
  stage.program = std::move(program);
  stage.frame = uniform_location(device_, stage.program, "nook_frame");
  device_.gl.UseProgram(stage.program.name());
  // If a stage does not have the sampler, the location is -1, which OpenGL ignores.
  for (const SamplerUnit& sampler : samplers)
    device_.gl.Uniform1i(uniform_location(device_, stage.program, sampler.name), sampler.unit);
}

void ScreenPass::make_watch(ScreenStage stage, bool has_radius) {
  watch_stage_ = std::move(stage);
  watch_question_ = uniform_location(device_, watch_stage_.program, "nook_question");
  watch_.emplace(device_, has_radius);
}

void ScreenPass::draw_watch(const NnaoFrame& frame, int layer, int question) const {
  set_frame(watch_stage_, frame_constants(frame, desc_, 0, layer));
  device_.gl.Uniform1i(watch_question_, question);
  draw(own_.framebuffer(), viewport_of(frame), false);
}

ImageFacts ScreenPass::check(const HostImages& images, bool changed) {
  if (changed) checked_.clear();
  if (const ImageFacts* const known = checked_.find(images)) return *known;
  ImageFacts facts;
  try {
    facts = check_images(device_, images, own_.texture(), target_framebuffer_.name());
  } catch (const Failure&) {
    checked_.clear();
    throw;
  }
  checked_.add(images, facts);
  if (facts.depth_bits > 0 && facts.depth_bits <= 16 && !coarse_depth_told_) {
    coarse_depth_told_ = true;
    device_.context.log(
        NOOK_LOG_WARNING,
        "nook_gl: frame.depth_texture %u has %d bits (GL_DEPTH_COMPONENT16 or half floats, need "
        "24 or more): AO shows bands; use GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT32F or "
        "GL_R32F",
        images.depth, facts.depth_bits);
  }
  return facts;
}

void ScreenPass::begin_frame() const {
  set_plain_drawing(device_.gl);
  device_.gl.BindVertexArray(vertex_array_.name());
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) device_.gl.BindSampler(unit, sampler_.name());
}

void ScreenPass::bind_texture(GLuint unit, GLuint texture) const {
  device_.gl.ActiveTexture(GL_TEXTURE0 + unit);
  device_.gl.BindTexture(GL_TEXTURE_2D, texture);
}

void ScreenPass::set_frame(const ScreenStage& stage, const FrameConstants& constants) const {
  device_.gl.UseProgram(stage.program.name());
  device_.gl.Uniform4fv(stage.frame, static_cast<GLsizei>(constants.values.size() / 4),
                        constants.values.data());
}

void ScreenPass::draw(GLuint framebuffer, const Viewport& viewport, bool discards) const {
  const Functions& gl = device_.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (discards) discard_colours(gl);
  set_viewport(gl, {float(viewport.x), float(viewport.y), float(viewport.width), float(viewport.height)});
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void ScreenPass::dispatch(const RenderTexture& target, GLenum format, int width, int height,
                          int group_size) const {
  const Functions& gl = device_.gl;
  const auto groups = [&](int length) { return GLuint((length + group_size - 1) / group_size); };
  gl.BindImageTexture(image_unit_index, target.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY, format);
  // The shader writes the texture. The barrier makes it wait for earlier reads of the texture and draws into
  // it, including the host's.
  gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  gl.DispatchCompute(groups(width), groups(height), 1);
  // The next stage reads the texture. The barrier makes the writes visible to it.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void ScreenPass::draw_output(const NnaoFrame& frame, int layer) const {
  const Functions& gl = device_.gl;
  const bool to_texture = frame.target == NOOK_TARGET_TEXTURE;
  GLuint framebuffer = own_.framebuffer();
  if (frame.target != NOOK_TARGET_OWN) {
    framebuffer = to_texture ? target_framebuffer_.name() : frame.target_name;
    if (gl.can.desktop_raster) gl.Enable(GL_FRAMEBUFFER_SRGB);  // always on in OpenGL ES
    if (frame.blend == NOOK_BLEND_MULTIPLY) set_blend(gl, multiplying);
  }
  if (desc_.views > 0) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    attach_layer(gl, to_texture ? frame.target_name : own_.texture(), layer);
  } else if (to_texture) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame.target_name, 0);
  }
  draw(framebuffer, viewport_of(frame), replaces_target(frame, desc_));
  // Detaches the host's texture. Otherwise its memory would not be freed when the host deletes it.
  if (to_texture) gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

}  // namespace nook::gl
