#include "sdk/src/gl/nnao/pass.h"

#include <algorithm>
#include <iterator>

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

bool replaces_target(const NnaoFrame& frame, const nook_nnao_desc& pass) {
  const Viewport viewport = viewport_of(frame);
  const bool own = frame.target == NOOK_TARGET_OWN;
  const int width = own ? pass.max_width : frame.width, height = own ? pass.max_height : frame.height;
  return frame.blend == NOOK_BLEND_WRITE && frame.target != NOOK_TARGET_FRAMEBUFFER &&
         viewport.width == width && viewport.height == height;
}

void NnaoPass::check(const NnaoFrame& frame) {
  const HostImages images = images_of(frame, desc_);
  if (checked_ == images && !frame.textures_changed) return;
  checked_.reset();
  check_images(device_, images, own_.texture(), target_framebuffer_.name());
  checked_ = images;
}

void NnaoPass::bind_texture(GLuint unit, GLuint texture) const {
  device_.gl.ActiveTexture(GL_TEXTURE0 + unit);
  device_.gl.BindTexture(GL_TEXTURE_2D, texture);
}

void NnaoPass::bind_host(GLuint unit, GLuint texture, bool samples) const {
  const GLenum array = samples ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY,
               plain = samples ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  device_.gl.ActiveTexture(GL_TEXTURE0 + unit);
  device_.gl.BindTexture(desc_.views > 0 ? array : plain, texture);
}

void NnaoPass::bind_depth(GLuint texture) const {
  bind_host(NOOK_UNIT_HOST_DEPTH, texture, desc_.depth_samples > 0);
}

void NnaoPass::bind_normals(GLuint texture) const {
  bind_host(NOOK_UNIT_NORMAL, texture, desc_.normal_samples > 0);
}

void NnaoPass::set_frame(const Stage& stage, const FrameConstants& constants) const {
  device_.gl.UseProgram(stage.program.name());
  device_.gl.Uniform4fv(stage.frame, static_cast<GLsizei>(constants.values.size() / 4),
                        constants.values.data());
}

void NnaoPass::draw(const Stage& stage, const FrameConstants& constants, GLuint framebuffer,
                    const Viewport& viewport, bool discards) const {
  const Functions& gl = device_.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  if (discards) discard_colours(gl);
  set_viewport(gl, {float(viewport.x), float(viewport.y), float(viewport.width), float(viewport.height)});
  set_frame(stage, constants);
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

void NnaoPass::run_network(const FrameConstants& constants, const Viewport& surface) const {
  const Functions& gl = device_.gl;
  if (path_ == NOOK_NNAO_PATH_FRAGMENT) {
    draw(occlusion_stage_, constants, ao_[0].framebuffer(), surface);
    return;
  }
  set_frame(occlusion_stage_, constants);
  // occlusion.comp declares the image in this way. OpenGL 4.3 has images of GL_RG8, OpenGL ES 3.1 of
  // GL_RGBA8, which bent normals need as well.
  gl.BindImageTexture(image_unit_index, ao_[0].texture(), 0, GL_FALSE, 0, GL_WRITE_ONLY,
                      gl.can.r8_images && !desc_.bent_normals ? GL_RG8 : GL_RGBA8);
  // Pending reads and draws, also of the host, end before the texture is written.
  gl.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  gl.DispatchCompute(groups(surface.width), groups(surface.height), 1);
  // The next stage reads the texture.
  gl.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

GLuint NnaoPass::accumulate(const NnaoFrame& frame, const FrameConstants& constants, const Viewport& surface,
                            LayerTextures& kept) {
  const std::size_t now = turn(kept), before = 1 - now;
  const HistoryConstants values = history_constants(frame, desc_, constants, kept.earlier);
  bind_texture(NOOK_UNIT_AO, ao_[0].texture());
  bind_texture(NOOK_UNIT_HISTORY, kept.history[before].texture());
  bind_texture(NOOK_UNIT_HISTORY_DEPTH, kept.depth[before].texture());
  bind_host(NOOK_UNIT_MOTION, frame.motion_vectors);
  device_.gl.UseProgram(accumulate_stage_.program.name());
  device_.gl.Uniform4fv(earlier_location_, NOOK_EARLIER_VEC4S, values.data());
  draw(accumulate_stage_, constants, kept.history[now].framebuffer(), surface);
  kept.earlier = {kept.earlier.count + 1, true, constants, surface.width, surface.height, {}};
  std::copy(std::begin(frame.view), std::end(frame.view), kept.earlier.view);
  return kept.history[now].texture();
}

void NnaoPass::draw_output(const Stage& stage, const NnaoFrame& frame, const FrameConstants& constants,
                           int layer) {
  const Functions& gl = device_.gl;
  const bool to_texture = frame.target == NOOK_TARGET_TEXTURE;
  GLuint framebuffer = own_.framebuffer();
  if (frame.target != NOOK_TARGET_OWN) {
    framebuffer = to_texture ? target_framebuffer_.name() : frame.target_name;
    if (gl.can.desktop_raster) gl.Enable(GL_FRAMEBUFFER_SRGB);  // OpenGL ES has no switch: it is on
    if (frame.blend == NOOK_BLEND_MULTIPLY) set_blend(gl, multiplying);
  }
  if (desc_.views > 0) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    attach_layer(gl, to_texture ? frame.target_name : own_.texture(), layer);
  } else if (to_texture) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, frame.target_name, 0);
  }
  draw(stage, constants, framebuffer, viewport_of(frame), replaces_target(frame, desc_));
  // If it stayed attached, a texture that the host deletes would live on.
  if (to_texture) gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, 0, 0);
}

void NnaoPass::render(const NnaoFrame& frame) {
  check(frame);
  const Functions& gl = device_.gl;
  set_plain_drawing(gl);
  gl.BindVertexArray(vertex_array_.name());
  for (GLuint unit = 0; unit < texture_unit_count; ++unit) gl.BindSampler(unit, sampler_.name());
  if (desc_.views == 0) {
    render_layer(frame, 0);
    return;
  }
  for (int layer = 0; layer < desc_.views; ++layer) {
    if (layer > 0) set_plain_drawing(gl);  // the output of the layer before may have left blending on
    render_layer(layer_frame(frame, layer), layer);
  }
}

void NnaoPass::render_layer(const NnaoFrame& frame, int layer) {
  LayerTextures& kept = textures_of(layer);
  const FrameConstants constants = frame_constants(frame, desc_, kept.earlier.count, layer);
  const RenderTexture& depth = kept.depth[turn(kept)];
  const Viewport viewport = viewport_of(frame);
  const Viewport surface{0, 0, surface_length(viewport.width, half()),
                         surface_length(viewport.height, half())};
  const bool layered = frame.gbuffer_ao != NOOK_GBUFFER_AO_NONE;
  if (timer_) timer_->begin_frame();

  // No texture that a stage draws into stays bound.
  for (const GLuint unit : {NOOK_UNIT_DEPTH, NOOK_UNIT_AO, NOOK_UNIT_LAYER, NOOK_UNIT_MOTION})
    bind_texture(unit, 0);
  if (desc_.views > 0)
    for (const int unit : {NOOK_UNIT_LAYER, NOOK_UNIT_MOTION}) bind_host(GLuint(unit), 0);
  bind_depth(frame.depth_texture);
  const bool apart = frame.gbuffer_ao == NOOK_GBUFFER_AO_EXCLUDE;
  if (apart) bind_host(NOOK_UNIT_LAYER, frame.gbuffer_ao_texture);
  draw(apart ? apart_depth_stage_ : depth_stage_, constants, depth.framebuffer(), surface);
  bind_texture(NOOK_UNIT_DEPTH, depth.texture());
  bind_normals(frame.normal_texture);
  if (normals_stage_.program.name() != 0) {
    draw(normals_stage_, constants, normals_.framebuffer(), surface);
    bind_texture(NOOK_UNIT_NORMAL, normals_.texture());
    filters_.bind(device_);
  }
  end_stage();

  if (frame.show == NOOK_NNAO_VIEW_NORMALS) {
    bind_normals(frame.normal_texture);
    // The timer counts four stages in every frame. This view has no occlusion and no blur, so both end at
    // once.
    end_stage();
    end_stage();
    draw_output(show_normals_stage_, frame, constants, layer);
    end_stage();
    return;
  }
  run_network(constants, surface);
  const GLuint mean = temporal() ? accumulate(frame, constants, surface, kept) : ao_[0].texture();
  end_stage();
  bind_depth(frame.depth_texture);
  bind_texture(NOOK_UNIT_AO, frame.show == NOOK_NNAO_VIEW_RAW ? ao_[0].texture() : mean);
  bind_host(NOOK_UNIT_LAYER, layered ? frame.gbuffer_ao_texture : 0);
  for (int pass = 0; pass < drawn_filters(desc_); ++pass) {
    draw(filter_stage_, constants, ao_[(pass + 1) % 2].framebuffer(), surface);
    bind_texture(NOOK_UNIT_AO, ao_[(pass + 1) % 2].texture());
  }
  end_stage();
  // The views for debugging have no layer.
  const bool combined = layered && frame.show == NOOK_NNAO_VIEW_AO;
  draw_output(combined ? layered_stage_ : resolve_stage_, frame, constants, layer);
  end_stage();
}

}  // namespace nook::gl
