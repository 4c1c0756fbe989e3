#include "sdk/src/gl/nnao/frame_constants.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sdk/src/nnao/filter.h"
#include "sdk/src/nnao/frame_radius.h"
#include "sdk/src/nnao/host_depth.h"

namespace nook::gl {
namespace {

// Texel i of the half-size surface is pixel 2 i: its centre i + 0.5 is at 2 i + 0.5.
nnao::ScreenRays half_rays(nnao::ScreenRays rays) {
  rays.x_offset -= 0.5f * rays.x_scale;
  rays.y_offset -= 0.5f * rays.y_scale;
  rays.x_scale *= 2;
  rays.y_scale *= 2;
  return rays;
}

}  // namespace

Viewport viewport_of(const NnaoFrame& frame) {
  const int32_t* v = frame.viewport;
  if (v[0] == 0 && v[1] == 0 && v[2] == 0 && v[3] == 0) return {0, 0, frame.width, frame.height};
  return {v[0], v[1], v[2], v[3]};
}

NnaoFrame layer_frame(const NnaoFrame& frame, int layer) {
  NnaoFrame one = frame;
  const auto put = [&](const float* given, auto& numbers) {
    if (given) std::copy_n(given + std::size_t(layer) * std::size(numbers), std::size(numbers), numbers);
  };
  put(frame.view_projections, one.projection);
  put(frame.view_matrices, one.view);
  put(frame.view_normal_matrices, one.normal_matrix);
  return one;
}

FrameConstants frame_constants(const NnaoFrame& frame, const nook_nnao_desc& pass, std::uint32_t count,
                               int layer) {
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
  const bool filters = pass.blur && frame.show != NOOK_NNAO_VIEW_RAW;
  const bool half = pass.half_resolution != 0, strengthened = frame.show == NOOK_NNAO_VIEW_AO;
  const Viewport viewport = viewport_of(frame);
  const nnao::ScreenRays screen =
      nnao::projection_rays(frame.projection, std::uint32_t(viewport.width), std::uint32_t(viewport.height));
  const bool perspective = nnao::is_perspective(frame.projection);
  const nnao::DepthDecode decode = nnao::depth_decode(
      {frame.projection, nnao::DepthKind(frame.depth_kind), nnao::ClipRange(frame.clip_space),
       frame.sky_depth, frame.depth_log_scale, frame.depth_log_near, frame.depth_log_far});
  const nnao::FrameRadius radius = nnao::frame_radius(
      {nnao::RadiusKind(frame.radius_kind), frame.radius, frame.scene_size, frame.max_radius_px},
      float(viewport.height));
  // The extent of the radius in pixels at a depth is this times the extent at that depth.
  const float radius_extent = radius.max_px * std::abs(screen.y_scale);
  const int surface_width = surface_length(viewport.width, half),
            surface_height = surface_length(viewport.height, half);
  const float* n = frame.normal_matrix;
  set_rays(NOOK_FRAME_SCREEN_RAYS, screen);
  set_rays(NOOK_FRAME_SURFACE_RAYS, half ? half_rays(screen) : screen);
  set(NOOK_FRAME_DEPTH_DECODE, decode.x, decode.y, decode.z, decode.w);
  set(NOOK_FRAME_FAR, decode.far_stored, decode.far_sign, nnao::min_surface_depth(perspective),
      pass.bent_normals && frame.blend == NOOK_BLEND_WRITE);
  set(NOOK_FRAME_SPREAD, perspective, !perspective,
      radius.in_pixels ? 0 : pass.blur_sharpness / radius.metres,
      nnao::filter_range_sharpness(std::uint32_t(pass.taps)));
  set(NOOK_FRAME_RADIUS, radius.metres, std::max(half ? 0.5f * radius.max_px : radius.max_px, 1.0f),
      strengthened ? frame.intensity : 1, strengthened ? frame.power : 1);
  set(NOOK_FRAME_NORMAL, frame.normal_scale, frame.normal_bias, frame.normal_texture != 0,
      strengthened ? float(frame.gbuffer_ao) : 0);
  set(NOOK_FRAME_VIEWPORT, float(viewport.x), float(viewport.y), float(viewport.width),
      float(viewport.height));
  set(NOOK_FRAME_SURFACE, float(surface_width - 1), float(surface_height - 1), float(surface_width),
      float(surface_height));
  set(NOOK_FRAME_INPUT, decode.log_rate, radius.in_pixels ? pass.blur_sharpness / radius_extent : 0,
      float(layer), 0);
  const nnao::TapNoise shift = nnao::frame_noise_step(count);
  const float last[] = {shift.rotation, shift.offset, float(filters)};
  for (int column = 0; column < 3; ++column)
    set(NOOK_FRAME_NORMAL_MATRIX + column, n[3 * column], n[3 * column + 1], n[3 * column + 2], last[column]);
  return constants;
}

}  // namespace nook::gl
