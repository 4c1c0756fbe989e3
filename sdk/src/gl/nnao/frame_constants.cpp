#include "sdk/src/gl/nnao/frame_constants.h"

#include <algorithm>

#include "sdk/src/nnao/evaluate.h"
#include "sdk/src/nnao/filter.h"

namespace nook::gl {
namespace {

// Depth = (x + y stored) / (z + w stored), and the stored value of the far plane.
struct DepthDecode {
  float x = 0, y = 1, z = 1, w = 0;
  float far_stored = 1e30f;  // values from here on are no surface
  float far_sign = 1;
};

bool perspective(const nook_nnao_frame_desc& frame) {
  return frame.projection[11] < 0;
}

// The matrix is defined up to a factor; here clip w is -z or 1.
double factor(const nook_nnao_frame_desc& frame) {
  return 1.0 / (perspective(frame) ? -double(frame.projection[11]) : double(frame.projection[15]));
}

DepthDecode depth_decode(const nook_nnao_frame_desc& frame) {
  DepthDecode decode;
  if (frame.depth_kind == NOOK_NNAO_DEPTH_LINEAR) {
    if (frame.sky_depth > 0) decode.far_stored = frame.sky_depth;
    return decode;
  }
  const double m10 = frame.projection[10] * factor(frame), m14 = frame.projection[14] * factor(frame);
  // ndc = scale stored + offset.
  const bool zero_to_one = frame.clip == NOOK_NNAO_CLIP_ZERO_TO_ONE;
  const double scale = zero_to_one ? 1 : 2, offset = zero_to_one ? 0 : -1;
  bool grows = false;
  if (perspective(frame)) {  // ndc = m14 / depth - m10
    decode.x = float(m14);
    decode.y = 0;
    decode.z = float(offset + m10);
    decode.w = float(scale);
    grows = m14 < 0;
  } else {  // ndc = m14 - m10 depth
    decode.x = float((m14 - offset) / m10);
    decode.y = float(-scale / m10);
    grows = m10 < 0;
  }
  decode.far_stored = grows ? 1 : 0;
  decode.far_sign = grows ? 1 : -1;
  return decode;
}

nnao::ScreenRays rays_of(const nook_nnao_frame_desc& frame, const Viewport& viewport) {
  float projection[16];
  for (int i = 0; i < 16; ++i) projection[i] = float(frame.projection[i] * factor(frame));
  if (!perspective(frame)) projection[11] = 0;
  return nnao::screen_rays(projection, std::uint32_t(viewport.width), std::uint32_t(viewport.height));
}

// Texel i of the half-size surface is pixel 2 i: its centre i + 0.5 is at 2 i + 0.5.
nnao::ScreenRays half_rays(nnao::ScreenRays rays) {
  rays.x_offset -= 0.5f * rays.x_scale;
  rays.y_offset -= 0.5f * rays.y_scale;
  rays.x_scale *= 2;
  rays.y_scale *= 2;
  return rays;
}

}  // namespace

Viewport viewport_of(const nook_nnao_frame_desc& frame) {
  const int32_t* v = frame.viewport;
  if (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0) return {0, 0, frame.width, frame.height};
  return {v[0], v[1], v[2], v[3]};
}

FrameConstants frame_constants(const nook_nnao_frame_desc& frame, const nook_nnao_desc& pass) {
  FrameConstants constants;
  const auto set = [&](int row, float x, float y, float z, float w) {
    const std::array values{x, y, z, w};
    std::copy(values.begin(), values.end(), &constants.values[std::size_t(4 * row)]);
  };
  // From the number of a pixel to the ray through its centre.
  const auto set_rays = [&](int row, const nnao::ScreenRays& rays) {
    set(row, rays.x_scale, rays.x_offset + 0.5f * rays.x_scale, rays.y_scale,
        rays.y_offset + 0.5f * rays.y_scale);
  };
  // With this range sharpness the filter averages equal values alone, which changes nothing.
  constexpr float no_range = 1e9f;
  const bool filters = pass.blur && frame.view != NOOK_NNAO_VIEW_RAW;
  const bool half = pass.half_resolution != 0, strengthened = frame.view == NOOK_NNAO_VIEW_AO;
  const Viewport viewport = viewport_of(frame);
  const nnao::ScreenRays screen = rays_of(frame, viewport);
  const DepthDecode decode = depth_decode(frame);
  const float max_radius_px = frame.max_radius_px > 0 ? frame.max_radius_px : 0.25f * float(viewport.height);
  const int surface_width = surface_length(viewport.width, half),
            surface_height = surface_length(viewport.height, half);
  const float* n = frame.normal_matrix;
  set_rays(NOOK_FRAME_SCREEN_RAYS, screen);
  set_rays(NOOK_FRAME_SURFACE_RAYS, half ? half_rays(screen) : screen);
  set(NOOK_FRAME_DEPTH_DECODE, decode.x, decode.y, decode.z, decode.w);
  set(NOOK_FRAME_FAR, decode.far_stored, decode.far_sign, perspective(frame) ? 0 : -1e15f,
      pass.bent_normals && frame.blend == NOOK_NNAO_WRITE);
  set(NOOK_FRAME_SPREAD, perspective(frame), !perspective(frame), pass.blur_sharpness / frame.radius,
      filters ? nnao::filter_range_sharpness(std::uint32_t(pass.taps)) : no_range);
  set(NOOK_FRAME_RADIUS, frame.radius, std::max(half ? 0.5f * max_radius_px : max_radius_px, 1.0f),
      strengthened ? frame.intensity : 1, strengthened ? frame.power : 1);
  set(NOOK_FRAME_NORMAL, frame.normal_scale, frame.normal_bias, frame.normal_texture != 0,
      strengthened ? float(frame.layer) : 0);
  set(NOOK_FRAME_VIEWPORT, float(viewport.x), float(viewport.y), float(viewport.width),
      float(viewport.height));
  set(NOOK_FRAME_SURFACE, float(surface_width - 1), float(surface_height - 1), float(surface_width),
      float(surface_height));
  for (int column = 0; column < 3; ++column)
    set(NOOK_FRAME_NORMAL_MATRIX + column, n[3 * column], n[3 * column + 1], n[3 * column + 2], 0);
  return constants;
}

}  // namespace nook::gl
