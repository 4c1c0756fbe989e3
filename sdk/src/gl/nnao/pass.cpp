#include "sdk/src/gl/nnao/pass.h"

#include <algorithm>
#include <iterator>

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/state_guard.h"
#include "shaders/nnao/layout.h"

namespace nook::gl {

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

void NnaoPass::draw_stage(const ScreenStage& stage, const FrameConstants& constants,
                          const RenderTexture& target, const Viewport& viewport) const {
  set_frame(stage, constants);
  draw(target.framebuffer(), viewport, true);
}

void NnaoPass::run_network(const FrameConstants& constants, const Viewport& surface) const {
  if (path_ == NOOK_NNAO_PATH_FRAGMENT) {
    draw_stage(occlusion_stage_, constants, ao_[0], surface);
    return;
  }
  set_frame(occlusion_stage_, constants);
  // This must be the image format that occlusion.comp declares. OpenGL 4.3 supports GL_RG8 images. OpenGL ES
  // 3.1 supports only GL_RGBA8, which is also the format for bent normals.
  dispatch(ao_[0], device_.gl.can.r8_images && !desc_.bent_normals ? GL_RG8 : GL_RGBA8, surface.width,
           surface.height, NOOK_OCCLUSION_GROUP_SIZE);
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
  draw_stage(accumulate_stage_, constants, kept.history[now], surface);
  kept.earlier = {kept.earlier.count + 1, true, constants, surface.width, surface.height, {}};
  std::copy(std::begin(frame.view), std::end(frame.view), kept.earlier.view);
  return kept.history[now].texture();
}

void NnaoPass::render(NnaoFrame& frame) {
  frame.normalised_normals = check(images_of(frame, desc_), frame.textures_changed).normalised_normals;
  begin_frame();
  watch_surfaces(frame, [&](const NnaoFrame& layer) {
    bind_depth(layer.depth_texture);
    bind_host(NOOK_UNIT_LAYER, layer.gbuffer_ao != NOOK_GBUFFER_AO_NONE ? layer.gbuffer_ao_texture : 0);
  });
  if (desc_.views == 0) {
    render_layer(frame, 0);
    return;
  }
  for (int layer = 0; layer < desc_.views; ++layer) {
    if (layer > 0)
      set_plain_drawing(device_.gl);  // the previous layer's output may have left blending enabled
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

  // Unbinds all inputs, because a later stage may draw into one of them.
  for (const GLuint unit : {NOOK_UNIT_DEPTH, NOOK_UNIT_AO, NOOK_UNIT_LAYER, NOOK_UNIT_MOTION})
    bind_texture(unit, 0);
  if (desc_.views > 0)
    for (const int unit : {NOOK_UNIT_LAYER, NOOK_UNIT_MOTION}) bind_host(GLuint(unit), 0);
  bind_depth(frame.depth_texture);
  const bool apart = frame.gbuffer_ao == NOOK_GBUFFER_AO_EXCLUDE;
  if (apart) bind_host(NOOK_UNIT_LAYER, frame.gbuffer_ao_texture);
  draw_stage(apart ? apart_depth_stage_ : depth_stage_, constants, depth, surface);
  bind_texture(NOOK_UNIT_DEPTH, depth.texture());
  bind_normals(frame.normal_texture);
  if (normals_stage_.program.name() != 0) {
    draw_stage(normals_stage_, constants, normals_, surface);
    bind_texture(NOOK_UNIT_NORMAL, normals_.texture());
    filters_.bind(device_);
  }
  end_stage();

  if (frame.show == NOOK_NNAO_VIEW_NORMALS) {
    bind_normals(frame.normal_texture);
    // The timer expects the same stages in every frame. This view has no occlusion and blur stages, so both
    // end immediately.
    end_stage();
    end_stage();
    set_frame(show_normals_stage_, constants);
    draw_output(frame, layer);
    end_stage();
    return;
  }
  run_network(constants, surface);
  const GLuint mean = temporal() ? accumulate(frame, constants, surface, kept) : ao_[0].texture();
  end_stage();
  bind_depth(frame.depth_texture);
  bind_texture(NOOK_UNIT_AO, frame.show == NOOK_NNAO_VIEW_RAW ? ao_[0].texture() : mean);
  bind_host(NOOK_UNIT_LAYER, layered ? frame.gbuffer_ao_texture : 0);
  for (int pass = 0; pass < filter_draws(desc_); ++pass) {
    draw_stage(filter_stages_[pass % 2], constants, ao_[(pass + 1) % 2], surface);
    bind_texture(NOOK_UNIT_AO, ao_[(pass + 1) % 2].texture());
  }
  end_stage();
  // Debug views do not include the host's layer.
  const bool combined = layered && frame.show == NOOK_NNAO_VIEW_AO;
  set_frame(combined ? layered_stage_ : resolve_stage_, constants);
  draw_output(frame, layer);
  end_stage();
}

}  // namespace nook::gl
