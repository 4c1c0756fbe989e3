#include "bakers/measure/nnao/frame_replay.h"

#include <algorithm>

namespace nook::measure {
namespace {

std::unique_ptr<GpuImage> image_of(const GladGLContext& gl, GLint internal_format, GLenum format, int width,
                                   int height, const Vector<float>& texels) {
  if (texels.empty()) return nullptr;
  return std::make_unique<GpuImage>(gl, internal_format, format, width, height, texels.data());
}

// Owns a pass.
struct Pass {
  Pass(nook_gl gl, const nook_nnao_desc& desc) { succeed(nook_nnao_create(gl, &desc, &handle)); }
  ~Pass() { nook_nnao_destroy(&handle); }
  Pass(const Pass&) = delete;
  Pass& operator=(const Pass&) = delete;

  nook_nnao handle = nullptr;
};

ScreenFrame frame_of(const nook::nnao::Recording& recording) {
  const nook::nnao::RecordedFrame& recorded = recording.frame;
  ScreenFrame frame;
  succeed(nook_gl_frame_desc_init(&frame));
  succeed(nook_gl_frame_desc_init(&frame));
  succeed(nook_nnao_frame_desc_init(&frame));
  frame.width = int(recording.width);
  frame.height = int(recording.height);
  frame.depth_kind = recorded.depth_kind;
  frame.sky_depth = recorded.sky_depth;
  frame.normal_scale = recorded.normal_scale;
  frame.normal_bias = recorded.normal_bias;
  std::ranges::copy(recorded.normal_matrix, frame.normal_matrix);
  std::ranges::copy(recorded.projection, frame.projection);
  frame.clip_space = recorded.clip;
  frame.radius = recorded.radius;
  frame.radius_kind = recorded.radius_kind;
  frame.max_radius_px = recorded.max_radius_px;
  frame.min_radius_px = recorded.min_radius_px;
  frame.fade_begin = recorded.fade_begin;
  frame.fade_end = recorded.fade_end;
  frame.intensity = recorded.intensity;
  frame.power = recorded.power;
  frame.gbuffer_ao = recorded.layer;
  return frame;
}

}  // namespace

bake::nnao::TracedView view_of_frame(const nook::nnao::Recording& recording) {
  bake::nnao::TracedView view;
  view.camera.width = recording.width;
  view.camera.height = recording.height;
  view.camera.rays =
      nook::nnao::projection_rays(recording.frame.projection, recording.width, recording.height);
  view.depth = nook::nnao::view_depths(recording);
  view.normal = nook::nnao::view_normals(recording, view.depth);
  return view;
}

FrameReplay::FrameReplay(const GladGLContext& gl, const NookGl& nook, const nook::nnao::Recording& recording)
    : gl_(gl),
      nook_(nook),
      recording_(recording),
      view_(view_of_frame(recording)),
      depth_(gl, GL_R32F, GL_RED, width(), height(), recording.depth.data()),
      normals_(image_of(gl, GL_RGB32F, GL_RGB, width(), height(), recording.normals)),
      layer_(image_of(gl, GL_RG32F, GL_RG, width(), height(), recording.layer)),
      gpu_view_(gl, view_) {}

std::vector<float> FrameReplay::draw(const nook::nnao::RecordedPass& settings,
                                     std::span<const std::byte> network, nook_nnao_view shown) const {
  nook_nnao_desc desc;
  succeed(nook_nnao_desc_init(&desc));
  desc.max_width = width();
  desc.max_height = height();
  desc.taps = settings.taps;
  desc.half_resolution = settings.half_resolution;
  desc.blur = settings.blur;
  desc.blur_sharpness = settings.blur_sharpness;
  nook_nnao_debug_desc debug;
  succeed(nook_nnao_debug_desc_init(&debug));
  debug.path = NOOK_NNAO_PATH_FRAGMENT;  // the fragment path and the compute path give the same bits
  desc.next = &debug;
  desc.network = network.empty() ? nullptr : network.data();
  desc.network_size = network.size();
  const Pass pass(nook_.get(), desc);
  ScreenFrame frame = frame_of(recording_);
  frame.depth_texture = depth_.texture();
  if (normals_) frame.normal_texture = normals_->texture();
  if (frame.gbuffer_ao != NOOK_GBUFFER_AO_NONE) frame.gbuffer_ao_texture = layer_->texture();
  nook_nnao_frame_debug_desc view;
  succeed(nook_nnao_frame_debug_desc_init(&view));
  view.show = shown;
  static_cast<nook_nnao_frame_desc&>(frame).next = &view;
  succeed(nook_nnao_render(pass.handle, &frame, &frame));
  nook_nnao_info info{};
  info.struct_size = sizeof info;
  succeed(nook_nnao_describe(pass.handle, &info));
  return read(info.texture);
}

AoRequest FrameReplay::request() const {
  AoRequest request;
  request.radius = recording_.frame.radius;
  request.max_radius_px =
      recording_.frame.max_radius_px > 0 ? recording_.frame.max_radius_px : 0.25f * float(height());
  request.blur_sharpness = recording_.pass.blur_sharpness;
  return request;
}

std::vector<float> FrameReplay::draw(Oracle oracle) {
  if (!oracle_) oracle_ = std::make_unique<OraclePass>(gl_, width(), height());
  return read(oracle_->draw(oracle, gpu_view_, recording_.frame.radius));
}

}  // namespace nook::measure
