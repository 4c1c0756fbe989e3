#include "sdk/src/nnao/host_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sdk/src/core/failure.h"

namespace nook::nnao {
namespace {

// Returns the factor by which to multiply the matrix so that clip w is -z (perspective) or 1 (orthographic).
// The factor does not change the projection.
double factor(const float (&projection)[16]) {
  return 1.0 / (is_perspective(projection) ? -double(projection[11]) : double(projection[15]));
}

// Depths of at least this many metres are not surfaces. The square of this number does not overflow a float.
constexpr float no_surface = 1e15f;

}  // namespace

std::size_t chosen_sample(SampleRule rule, std::span<const float> depths) {
  if (rule == SampleRule::first) return 0;
  if (rule == SampleRule::nearest)
    return std::size_t(std::min_element(depths.begin(), depths.end()) - depths.begin());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    std::size_t nearer = 0;
    for (std::size_t j = 0; j < depths.size(); ++j)
      nearer += depths[j] < depths[i] || (depths[j] == depths[i] && j < i);
    if (nearer == (depths.size() - 1) / 2) return i;
  }
  return 0;
}

bool is_perspective(const float (&projection)[16]) {
  return projection[11] < 0;
}

ScreenRays projection_rays(const float (&projection)[16], std::uint32_t width, std::uint32_t height) {
  float scaled[16];
  for (int i = 0; i < 16; ++i) scaled[i] = float(projection[i] * factor(projection));
  if (!is_perspective(projection)) scaled[11] = 0;
  return screen_rays(scaled, width, height);
}

namespace {

// An oblique projection adds m[2] x + m[6] y to clip z. After the division by w, this term is linear in the
// pixel's coordinates. The decoder subtracts it from the stored value. Its value at pixel (0, 0) is included
// in the constants, and the rest is stored as slopes.
void add_slope(DepthDecode& decode, const DepthSource& source, double stored_scale) {
  const auto& m = source.projection;
  const ScreenRays rays = projection_rays(m, source.width, source.height);
  const double per_x = m[2] * factor(m) / stored_scale, per_y = m[6] * factor(m) / stored_scale;
  decode.slope_x = float(-per_x * rays.x_scale);
  decode.slope_y = float(-per_y * rays.y_scale);
  const double first =
      -per_x * (rays.x_offset + 0.5 * rays.x_scale) - per_y * (rays.y_offset + 0.5 * rays.y_scale);
  decode.x = float(decode.x + decode.y * first);
  decode.z = float(decode.z + decode.w * first);
}

}  // namespace

DepthDecode depth_decode(const DepthSource& source) {
  DepthDecode decode;
  if (source.kind == DepthKind::linear) {
    if (source.sky_depth > 0) decode.far_stored = source.sky_depth;
    return decode;
  }
  if (source.kind == DepthKind::logarithmic) {
    const double per_metre = source.log_scale, near = source.log_near;
    decode.log_rate = float(std::log2(1 + per_metre * (source.log_far - near)));
    decode.x = float(near - 1 / per_metre);
    decode.y = float(1 / per_metre);
    decode.far_stored = 1;
    return decode;
  }
  const auto& m = source.projection;
  const double m10 = m[10] * factor(m), m14 = m[14] * factor(m);
  // ndc = scale * stored + offset.
  const bool zero_to_one = source.clip == ClipRange::zero_to_one;
  const double scale = zero_to_one ? 1 : 2, offset = zero_to_one ? 0 : -1;
  bool grows = false;
  if (is_perspective(m)) {  // ndc = m14 / depth - m10
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
  if (m[2] != 0 || m[6] != 0) add_slope(decode, source, scale);
  return decode;
}

float view_depth(const DepthDecode& decode, bool perspective, float stored, Pixel pixel) {
  constexpr float none = std::numeric_limits<float>::infinity();
  if ((stored - decode.far_stored) * decode.far_sign >= 0) return none;
  stored += decode.slope_x * float(pixel.x) + decode.slope_y * float(pixel.y);
  if (decode.log_rate != 0) stored = std::exp2(decode.log_rate * stored);
  const float depth = (decode.x + decode.y * stored) / (decode.z + decode.w * stored);
  // If depth is NaN, the comparisons are false and the result is `none`.
  return depth > min_surface_depth(perspective) && depth < no_surface ? depth : none;
}

namespace {

double determinant_of(const float (&m)[9]) {
  return double(m[0]) * (double(m[4]) * m[8] - double(m[7]) * m[5]) -
         double(m[3]) * (double(m[1]) * m[8] - double(m[7]) * m[2]) +
         double(m[6]) * (double(m[1]) * m[5] - double(m[4]) * m[2]);
}

}  // namespace

float mean_scale(const float (&m)[9]) {
  return float(std::cbrt(std::abs(determinant_of(m))));
}

void check_normal_matrix(const float (&m)[9]) {
  const double determinant = determinant_of(m);
  if (!std::isfinite(determinant) || std::abs(determinant) < 1e-12)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "frame.normal_matrix cannot be inverted (got the determinant %g, need a rotation to view space)",
        determinant);
}

}  // namespace nook::nnao
