// Interprets the host's projection and depth buffer: converts stored depth values to view depth, and checks
// matrices. Matrices are column-major, as in OpenGL.
#pragma once

#include "sdk/src/nnao/network_evaluate.h"

namespace nook::nnao {

// The values match nook_depth_kind and nook_clip_space.
enum class DepthKind { hardware = 0, linear = 1, logarithmic = 2 };
enum class ClipRange { negative_one_to_one = 0, zero_to_one = 1 };

struct DepthSource {
  const float (&projection)[16];
  DepthKind kind = DepthKind::hardware;
  ClipRange clip = ClipRange::negative_one_to_one;
  float sky_depth = 0;  // metres; linear depths of at least this value are sky; 0: no limit
  // The constants C, n and f of logarithmic depth, as the C interface defines them.
  float log_scale = 1, log_near = 0, log_far = 0;
  std::uint32_t width = 1, height = 1;  // size of the image; only used for an oblique projection
};

// The values match nook_nnao_sample.
enum class SampleRule { median = 0, first = 1, nearest = 2 };

// Returns the index of the sample that provides the pixel's depth. If depths are equal, the first sample is
// chosen. The median of an even number of samples is the nearer of the middle two. `depths` are view depths,
// infinite where there is no surface. Tests compare host_depth.glsl with this function.
std::size_t chosen_sample(SampleRule rule, std::span<const float> depths);

bool is_perspective(const float (&projection)[16]);

// Like screen_rays, but the matrix may be multiplied by any positive factor.
ScreenRays projection_rays(const float (&projection)[16], std::uint32_t width, std::uint32_t height);

// Depth = (x + y s) / (z + w s). If log_rate is not 0, s is exp2(log_rate * stored). Otherwise s is stored +
// slope_x * column + slope_y * row of the pixel. The slopes are 0 unless the projection is oblique.
struct DepthDecode {
  float x = 0, y = 1, z = 1, w = 0;
  float log_rate = 0;
  float far_stored = 1e30f;  // stored values from this limit on are not surfaces
  float far_sign = 1;        // 1: stored values increase with distance; -1: they decrease
  float slope_x = 0, slope_y = 0;
};
DepthDecode depth_decode(const DepthSource& source);

// Returns the exclusive lower limit for the view depth of a surface. In a perspective projection, the depth
// of a surface is positive.
constexpr float min_surface_depth(bool perspective) {
  return perspective ? 0 : -1e15f;
}

struct Pixel {
  std::uint32_t x = 0, y = 0;
};

// Returns the view depth of a stored value in metres, or infinity if there is no surface. Tests compare
// host_depth.glsl with it.
float view_depth(const DepthDecode& decode, bool perspective, float stored, Pixel pixel = {});

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if the matrix is not suitable. The message names the
// descriptor's field.
void check_normal_matrix(const float (&matrix)[9]);

// The minimum length of a normal. If the normal in a texel is shorter, the host has not drawn a normal there.
// The limit for normalised integers is higher. If a target is cleared to 1/2, it contains 128 / 255 or 512 /
// 1023. This decodes to components of 0.004 or 0.001, and to a length of 0.007 or 0.002.
inline constexpr float shortest_float_normal = 1e-3f, shortest_normalised_normal = 0.25f;

// Returns the mean factor by which a matrix scales lengths: the cube root of its determinant.
float mean_scale(const float (&matrix)[9]);

}  // namespace nook::nnao
