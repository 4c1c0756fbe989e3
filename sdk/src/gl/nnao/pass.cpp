#include "sdk/src/gl/nnao/pass.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/state_guard.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {
namespace {

constexpr GLuint groups(int texels) {
  return static_cast<GLuint>((texels + NOOK_OCCLUSION_GROUP_SIZE - 1) / NOOK_OCCLUSION_GROUP_SIZE);
}

// Multiplies the target by AO; alpha stays.
constexpr BlendState multiplying{GL_TRUE, GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE, GL_FUNC_ADD, GL_FUNC_ADD};

}  // namespace

bool NnaoPass::blurs(const nook_nnao_frame_desc& frame) const {
  return desc_.blur && frame.view != NOOK_NNAO_VIEW_RAW;
}

void NnaoPass::check(const nook_nnao_frame_desc& frame) {
  const HostImages images = images_of(frame);
  if (checked_ == images) return;
  checked_.reset();
  check_images(device_, images, own_.texture());
  if (images.target == NOOK_NNAO_TARGET_TEXTURE) {
    const Functions& gl = device_.gl;
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target_framebuffer_.name());
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, images.target_name, 0);
    const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
    if (status != GL_FRAMEBUFFER_COMPLETE)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "frame.target_name cannot be drawn into (got %u with the framebuffer status 0x%04x, need a "
          "colour format that OpenGL renders to)",
          images.target_name, status);
  }
  checked_ = images;
}

void NnaoPass::bind_texture(GLuint unit, GLuint texture) const {
  device_.gl.ActiveTexture(GL_TEXTURE0 + unit);
  device_.gl.BindTexture(GL_TEXTURE_2D, texture);
}

void NnaoPass::set_frame(const Stage& stage, const FrameConstants& constants) const {
  device_.gl.UseProgram(stage.program.name());
  device_.gl.Uniform4fv(stage.frame, static_cast<GLsizei>(constants.values.size() / 4),
                        constants.values.data());
}

void NnaoPass::draw(const Stage& stage, const FrameConstants& constants, GLuint framebuffer,
                    const Viewport& viewport) const {
  const Functions& gl = device_.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  set_viewport(gl, {float(viewport.x), float(viewport.y), float(viewport.width), float(viewport.height)});
  set_frame(stage, constants);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void NnaoPass::run_network(const FrameConstants& constants, const RenderTexture& into,
                           const Viewport& into_place) const {
  const Functions& gl = device_.gl;
  gl.UseProgram(occlusion_.program.name());
  gl.Uniform2i(occlusion_.ao_origin, into_place.x, into_place.y);
  if (path_ == NOOK_NNAO_PATH_FRAGMENT) {
    draw(occlusion_, constants, into.framebuffer(), into_place);
    return;
  }
  set_frame(occlusion_, constants);
  // occlusion.comp declares the image in this way. OpenGL 4.3 has images of GL_R8, OpenGL ES 3.1 of GL_RGBA8.
  gl.BindImageTexture(image_unit_index, into.texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                      gl.can.r8_images ? GL_R8 : GL_RGBA8);
  // Pending reads and draws, also of the host, end before the texture is written.
  gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  gl.DispatchCompute(groups(into_place.width), groups(into_place.height), 1);
  // The next stage reads the texture. If it is the own texture, the last stage also draws into it.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

void NnaoPass::draw_blur(const FrameConstants& constants, const RenderTexture& from,
                         const Viewport& from_place, bool vertical, const RenderTexture& into) const {
  const Functions& gl = device_.gl;
  bind_texture(NOOK_UNIT_AO, from.texture());
  gl.UseProgram(blur_.program.name());
  gl.Uniform2i(blur_.ao_origin, from_place.x, from_place.y);
  gl.Uniform2i(blur_.blur_axis, !vertical, vertical);
  gl.Uniform1i(blur_.blur_reach, NOOK_BLUR_REACH);
  draw(blur_, constants, into.framebuffer(), {0, 0, from_place.width, from_place.height});
}

void NnaoPass::draw_resolve(const nook_nnao_frame_desc& frame, const FrameConstants& constants,
                            const RenderTexture& ao) {
  const Functions& gl = device_.gl;
  const bool to_texture = frame.target == NOOK_NNAO_TARGET_TEXTURE;
  GLuint framebuffer = own_.framebuffer();
  bind_texture(NOOK_UNIT_DEPTH, frame.depth_texture);
  bind_texture(NOOK_UNIT_AO, ao.texture());
  bind_texture(NOOK_UNIT_LAYER, frame.layer != NOOK_NNAO_LAYER_NONE ? frame.layer_texture : 0);
  gl.UseProgram(resolve_.program.name());
  gl.Uniform2i(resolve_.blur_axis, 0, 1);
  gl.Uniform1i(resolve_.blur_reach, blurs(frame) ? NOOK_BLUR_REACH : 0);
  if (frame.target != NOOK_NNAO_TARGET_OWN) {
    framebuffer = to_texture ? target_framebuffer_.name() : frame.target_name;
    if (gl.can.desktop_raster) gl.Enable(GL_FRAMEBUFFER_SRGB);  // OpenGL ES has no switch: it is on
    if (frame.blend == NOOK_NNAO_MULTIPLY) set_blend(gl, multiplying);
  }
  if (to_texture) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame.target_name, 0);
  }
  draw(resolve_, constants, framebuffer, viewport_of(frame));
  // If it stayed attached, a texture that the host deletes would live on.
  if (to_texture) gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

void NnaoPass::render(const nook_nnao_frame_desc& frame) {
  check(frame);
  const Functions& gl = device_.gl;
  const FrameConstants constants = frame_constants(frame, desc_);
  const Viewport viewport = viewport_of(frame);
  const Viewport surface{0, 0, surface_length(viewport.width, half()),
                         surface_length(viewport.height, half())};
  if (timer_) timer_->begin_frame();
  set_plain_drawing(gl);
  gl.BindVertexArray(vertex_array_.name());
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) gl.BindSampler(unit, sampler_.name());

  bind_texture(NOOK_UNIT_AO, 0);
  bind_texture(NOOK_UNIT_LAYER, 0);
  bind_texture(NOOK_UNIT_DEPTH, frame.depth_texture);
  bind_texture(NOOK_UNIT_SURFACE, frame.normal_texture);
  draw(normals_, constants, surface_.framebuffer(), surface);
  end_stage();

  bind_texture(NOOK_UNIT_SURFACE, surface_.texture());
  if (filters_.made()) filters_.bind(device_);
  // At full resolution the last stage writes the own texture, so that AO is in the other texture before. Only
  // the viewport may change in the own texture.
  const RenderTexture& first = half() || !blurs(frame) ? ao_[0] : own_;
  const RenderTexture& second = half() ? ao_[1] : ao_[0];
  const Viewport& place = &first == &own_ ? viewport : surface;
  run_network(constants, first, place);
  end_stage();

  const RenderTexture* result = &first;
  if (blurs(frame)) {
    draw_blur(constants, first, place, false, second);
    result = &second;
    if (half()) {
      draw_blur(constants, second, surface, true, first);
      result = &first;
    }
  }
  end_stage();
  draw_resolve(frame, constants, *result);
  end_stage();
}

}  // namespace nook::gl
