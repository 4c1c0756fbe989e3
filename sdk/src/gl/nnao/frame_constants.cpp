#include <algorithm>
#include <cmath>
#include <iterator>

#include "sdk/src/gl/nnao/nnao_frame.h"
#include "sdk/src/nnao/filter.h"
#include "sdk/src/nnao/frame_radius.h"
#include "sdk/src/nnao/history.h"
#include "sdk/src/nnao/host_depth.h"

namespace nook::gl {
namespace {

// Converts rays to the half-size surface. Its texel i is pixel 2 i, so the texel's centre i + 0.5 maps to 2 i
// + 0.5.
nnao::ScreenRays half_rays(nnao::ScreenRays rays) {
  rays.x_offset -= 0.5f * rays.x_scale;
  rays.y_offset -= 0.5f * rays.y_scale;
  rays.x_scale *= 2;
  rays.y_scale *= 2;
  return rays;
}

// Returns the minimum length of a normal in the host's texels, or 0 if the host has no normals. If
// normal_matrix contains a scale, the minimum is scaled too.
float shortest_normal(const NnaoFrame& frame) {
  if (frame.normal_texture == 0) return 0;
  if (!frame.normalised_normals) return nnao::shortest_float_normal;
  return nnao::shortest_normalised_normal * nnao::mean_scale(frame.normal_matrix);
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

namespace {

// The weight of the centre texel with which the filter has no effect. The other weights sum to at most 2, so
// they change the result by far less than a step of 8 bits. The value fits into a 16-bit float.
constexpr float unfiltered_weight = 32768;

}  // namespace

FrameConstants frame_constants(const NnaoFrame& frame, const nook_nnao_desc& pass, std::uint32_t count,
                               int layer) {
  FrameConstants constants;
  const auto set = [&](int row, float x, float y, float z, float w) {
    const std::array values{x, y, z, w};
    std::copy(values.begin(), values.end(), &constants.values[std::size_t(4 * row)]);
  };
  // Sets the mapping from the integer coordinates of a pixel to the ray through the pixel's centre.
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
       frame.sky_depth, frame.depth_log_scale, frame.depth_log_near, frame.depth_log_far,
       std::uint32_t(viewport.width), std::uint32_t(viewport.height)});
  const nnao::FrameRadius radius =
      nnao::frame_radius({nnao::RadiusKind(frame.radius_kind), frame.radius, frame.scene_size,
                          frame.max_radius_px, frame.min_radius_px},
                         float(viewport.height));
  // The length in metres that max_px pixels cover at a depth of 1 metre. In a perspective projection, this
  // length is proportional to the depth.
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
  set(NOOK_FRAME_NORMAL, frame.normal_scale, frame.normal_bias, shortest_normal(frame),
      strengthened ? float(frame.gbuffer_ao) : 0);
  set(NOOK_FRAME_VIEWPORT, float(viewport.x), float(viewport.y), float(viewport.width),
      float(viewport.height));
  set(NOOK_FRAME_SURFACE, float(surface_width - 1), float(surface_height - 1), decode.slope_x,
      decode.slope_y);
  set(NOOK_FRAME_INPUT, decode.log_rate, radius.in_pixels ? pass.blur_sharpness / radius_extent : 0,
      float(layer), 0);
  const nnao::DistanceFade fade = nnao::distance_fade(frame.fade_begin, frame.fade_end);
  set(NOOK_FRAME_FADE, half ? 0.5f * radius.min_px : radius.min_px, fade.per_metre, fade.offset, 0);
  const nnao::TapNoise shift = nnao::frame_noise_step(count);
  const float last[] = {shift.rotation, shift.offset, filters ? 1 : unfiltered_weight};
  for (int column = 0; column < 3; ++column)
    set(NOOK_FRAME_NORMAL_MATRIX + column, n[3 * column], n[3 * column + 1], n[3 * column + 2], last[column]);
  return constants;
}

namespace {

const float* row(const FrameConstants& constants, int index) {
  return &constants.values[std::size_t(4 * index)];
}

bool is_cut(const NnaoFrame& frame, const FrameConstants& constants, const EarlierFrame& earlier) {
  const float* surface = row(constants, NOOK_FRAME_SURFACE);
  return frame.reset || !earlier.drawn || float(earlier.width - 1) != surface[0] ||
         float(earlier.height - 1) != surface[1] ||
         row(earlier.constants, NOOK_FRAME_SPREAD)[0] != row(constants, NOOK_FRAME_SPREAD)[0];
}

// The inverse of a view matrix: three rows of the rotation, then the translation.
struct Inverse {
  double rotation[9], translation[3];
};

// Computed in double precision, so that the product is as exact as if the host had computed it.
Inverse inverse_of(const float (&m)[16]) {
  const auto at = [&](int row, int column) { return double(m[4 * column + row]); };
  const auto minor = [&](int row, int column) {
    const int r0 = (row + 1) % 3, r1 = (row + 2) % 3, c0 = (column + 1) % 3, c1 = (column + 2) % 3;
    return at(r0, c0) * at(r1, c1) - at(r0, c1) * at(r1, c0);
  };
  const double determinant = at(0, 0) * minor(0, 0) + at(0, 1) * minor(0, 1) + at(0, 2) * minor(0, 2);
  Inverse inverse{};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      inverse.rotation[3 * row + column] = minor(column, row) / determinant;
      inverse.translation[row] -= inverse.rotation[3 * row + column] * at(column, 3);
    }
  return inverse;
}

}  // namespace

Mat3x4 earlier_from_view(const float (&earlier)[16], const float (&view)[16]) {
  Mat3x4 product;
  if (std::equal(std::begin(view), std::end(view), earlier)) return product;  // exactly the identity
  const Inverse inverse = inverse_of(view);
  const auto at = [&](int row, int column) { return double(earlier[4 * column + row]); };
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double sum = 0;
      for (int k = 0; k < 3; ++k) sum += at(row, k) * inverse.rotation[3 * k + column];
      product.m[4 * row + column] = float(sum);
    }
    double sum = at(row, 3);
    for (int k = 0; k < 3; ++k) sum += at(row, k) * inverse.translation[k];
    product.m[4 * row + 3] = float(sum);
  }
  return product;
}

HistoryConstants history_constants(const NnaoFrame& frame, const nook_nnao_desc& pass,
                                   const FrameConstants& constants, const EarlierFrame& earlier) {
  HistoryConstants values{};
  // Without a previous frame, the history is not read, so any matrix can be used.
  const Mat3x4 motion = earlier.drawn ? earlier_from_view(earlier.view, frame.view) : Mat3x4{};
  std::copy_n(motion.m, 12, values.begin());
  const auto set = [&](int index, std::array<float, 4> four) {
    std::copy(four.begin(), four.end(), values.begin() + std::ptrdiff_t(4 * index));
  };
  const float* rays = row(earlier.constants, NOOK_FRAME_SURFACE_RAYS);
  set(NOOK_EARLIER_RAYS, {rays[0], rays[1], rays[2], rays[3]});
  const bool cut = is_cut(frame, constants, earlier);
  set(NOOK_EARLIER_SIZE, {float(earlier.width - 1), float(earlier.height - 1),
                          cut ? 1.0f : float(pass.max_history_frames), frame.motion_vectors ? 1.0f : 0.0f});
  const float per_pixel = pass.half_resolution ? 0.5f : 1.0f;
  set(NOOK_EARLIER_MOTION,
      {per_pixel * frame.motion_vector_scale[0], per_pixel * frame.motion_vector_scale[1],
       nnao::noise_reach(std::uint32_t(pass.taps)), 0});
  return values;
}

}  // namespace nook::gl
