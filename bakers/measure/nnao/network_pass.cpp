#include "bakers/measure/nnao/network_pass.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

// Sets a projection matrix like those of glFrustum, with which each pixel has its ray of the view. The pass
// reads linear depth, so the third row only has to make the matrix invertible.
void set_projection(const GpuView& view, float (&projection)[16]) {
  std::fill_n(projection, 16, 0.0f);
  projection[0] = 2 / (view.rays.x_scale * float(view.width));
  projection[5] = 2 / (view.rays.y_scale * float(view.height));
  projection[8] = 2 * view.rays.x_offset / (view.rays.x_scale * float(view.width)) + 1;
  projection[9] = 2 * view.rays.y_offset / (view.rays.y_scale * float(view.height)) + 1;
  projection[10] = -1;
  projection[11] = -1;
  projection[14] = -0.02f;
}

}  // namespace

void succeed(nook_result result) {
  if (result != NOOK_OK) throw Failure(result, "%s", nook_last_message());
}

void set_view(const Mat3x4& world_from_view, float (&view)[16]) {
  const float* const m = world_from_view.m;
  const Vec3 eye{m[3], m[7], m[11]};
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 column{m[axis], m[4 + axis], m[8 + axis]};
    view[axis] = column.x;
    view[4 + axis] = column.y;
    view[8 + axis] = column.z;
    view[12 + axis] = -dot(column, eye);
    view[4 * axis + 3] = 0;
  }
  view[15] = 1;
}

ScreenFrame frame_of(const GpuView& view) {
  ScreenFrame frame;
  succeed(nook_gl_frame_desc_init(&frame));
  succeed(nook_gl_frame_desc_init(&frame));
  succeed(nook_nnao_frame_desc_init(&frame));
  frame.width = view.width;
  frame.height = view.height;
  frame.depth_texture = view.depth.texture();
  frame.depth_kind = NOOK_DEPTH_LINEAR;
  frame.normal_texture = view.normal.texture();
  set_projection(view, frame.projection);
  return frame;
}

NookGl::NookGl(platform::Context& context) {
  nook_context_desc context_desc;
  succeed(nook_context_desc_init(&context_desc));
  succeed(nook_context_create(&context_desc, &context_));
  nook_gl_desc gl_desc;
  succeed(nook_gl_desc_init(&gl_desc));
  gl_desc.get_proc = platform::Context::loader;
  gl_desc.get_proc_user = &context;
  succeed(nook_gl_create(context_, &gl_desc, &gl_));
}

NookGl::~NookGl() {
  nook_gl_destroy(&gl_);
  nook_context_destroy(&context_);
}

NetworkPass::NetworkPass(const NookGl& gl, int width, int height, const NetworkForm& form,
                         std::span<const std::byte> network, float blur_sharpness)
    : form_(form) {
  nook_nnao_desc desc;
  succeed(nook_nnao_desc_init(&desc));
  desc.max_width = width;
  desc.max_height = height;
  desc.taps = form.taps;
  desc.half_resolution = form.half_resolution;
  desc.blur = form.blur;
  desc.blur_sharpness = blur_sharpness;
  desc.bent_normals = form.bent;
  desc.max_history_frames = form.temporal_frames;
  nook_nnao_debug_desc debug;
  succeed(nook_nnao_debug_desc_init(&debug));
  debug.path = form.path;
  desc.next = &debug;
  desc.network = network.empty() ? nullptr : network.data();
  desc.network_size = network.size();
  succeed(nook_nnao_create(gl.get(), &desc, &pass_));
  info_.struct_size = sizeof info_;
  succeed(nook_nnao_describe(pass_, &info_));
}

NetworkPass::~NetworkPass() {
  nook_nnao_destroy(&pass_);
}

GLuint NetworkPass::draw(const GpuView& view, const AoRequest& request, bool blurred,
                         const std::optional<Mat3x4>& world_from_view, bool cut, GLuint motion) {
  ScreenFrame frame = frame_of(view);
  frame.radius = request.radius;
  frame.max_radius_px = request.max_radius_px;
  frame.min_radius_px = request.min_radius_px;
  nook_nnao_frame_debug_desc debug;
  succeed(nook_nnao_frame_debug_desc_init(&debug));
  debug.show = blurred ? NOOK_NNAO_VIEW_BLURRED : NOOK_NNAO_VIEW_RAW;
  static_cast<nook_nnao_frame_desc&>(frame).next = &debug;
  if (blurred && request.intensity != 1) {
    debug.show = NOOK_NNAO_VIEW_AO;
    frame.intensity = request.intensity;
  }
  frame.reset = cut;
  frame.motion_vectors = motion;
  if (world_from_view) set_view(*world_from_view, frame.view);
  succeed(nook_nnao_render(pass_, &frame, &frame));
  return info_.texture;
}

int NetworkPass::fetches(bool blurred) const {
  // Counts fetches. The first stage reads the host's depth. The main stage reads depth and its four
  // neighbours, the host's normal, and the taps. Each filter reads AO seven times along each axis. In the
  // paper's form, the stage for normals also reads depth, its four neighbours and the normal. At half
  // resolution, a quarter of the texels have these fetches. The upsample then reads the host's depth, four
  // depths and four AO values.
  const int before = horizon_form() ? 1 + 5 + 1 + info_.taps : 1 + 2 * 6 + 6 * info_.taps;
  const int filters = blurred ? 14 * form_.blur : 0;
  if (form_.half_resolution) return (before + filters) / 4 + 9;
  return before + (blurred ? filters : 14);
}

}  // namespace nook::measure
