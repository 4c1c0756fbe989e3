// Raw AO of a view by a network, one pixel at a time: the reference that the OpenGL pass is tested against
// and that training is measured by. View space is OpenGL's; rows count from the bottom.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/vec.h"
#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/taps.h"

namespace nook::nnao {

// The way from pixels to view space: at depth w = -z,
//   x = (x_scale px + x_offset) w, y = (y_scale py + y_offset) w,   perspective;
// the same without the factor w, orthographic. px, py are pixel coordinates; centres lie at + 0.5.
struct ScreenRays {
  float x_scale = 1, x_offset = 0, y_scale = 1, y_offset = 0;
  bool orthographic = false;
};

// From an OpenGL projection matrix (column-major) and the size of the screen; off-centre ones too. Depth
// ranges and their direction do not matter.
ScreenRays screen_rays(const float (&projection)[16], std::uint32_t width, std::uint32_t height);

inline Vec3 view_position(const ScreenRays& rays, float px, float py, float depth) {
  const float w = rays.orthographic ? 1 : depth;
  return {(rays.x_scale * px + rays.x_offset) * w, (rays.y_scale * py + rays.y_offset) * w, -depth};
}

inline PixelScale pixel_scale(const ScreenRays& rays, float depth) {
  const float w = rays.orthographic ? 1 : depth;
  return {1 / (rays.x_scale * w), 1 / (rays.y_scale * w)};
}

// The direction to the viewer.
inline Vec3 to_viewer(const ScreenRays& rays, Vec3 position) {
  return rays.orthographic ? Vec3{0, 0, 1} : normalised(-position);
}

struct View {
  std::uint32_t width = 0, height = 0;
  ScreenRays rays;
  std::span<const float> depth;  // -z, metres; not finite: the sky or the far plane
  std::span<const Vec3> normal;  // unit length, facing the viewer

  bool has_surface(std::uint32_t x, std::uint32_t y) const { return std::isfinite(depth[at(x, y)]); }
  std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t(y) * width + x; }
};

struct Sampling {
  float radius = 1;           // metres
  float max_radius_px = 256;  // where the radius covers more pixels, it shrinks
  std::uint32_t taps = 64;    // horizon form: one of horizon_tap_counts; paper form: 1 to 961
};

// The radius of one pixel after the clamp.
struct PixelRadius {
  float metres = 0, px = 0;
};
inline PixelRadius pixel_radius(const Sampling& sampling, PixelScale scale) {
  const float per_metre = std::abs(scale.y);
  const float px = std::min(sampling.radius * per_metre, sampling.max_radius_px);
  return {px / per_metre, px};
}

// The texel below a tap.
struct TappedTexel {
  bool on_screen = false;
  bool surface = false;  // on the screen, and not the sky
  std::uint32_t x = 0, y = 0;
};
TappedTexel tapped_texel(const View& view, std::uint32_t x, std::uint32_t y, TapOffset offset);

// The input to the horizon form of a tap that lies on the screen.
using HorizonTapInput = std::array<float, HorizonNetwork::tap_inputs>;
HorizonTapInput horizon_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal,
                                  Vec3 viewer, float radius);

// The same of a tap off the screen, where the pixel's own plane is taken to go on. across, facing: dot(n, t)
// and dot(n, o) of network.h; distance_r: of the tap on the screen, in radii.
HorizonTapInput plane_tap_input(float across, float facing, float distance_r);

// A tap's input to the paper's form; false where it is 0.
bool paper_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal, float radius,
                     std::array<float, PaperNetwork::tap_inputs>& input);

// The unit vector across the direction to the viewer in the plane of a screen direction.
inline Vec3 across_viewer(Vec3 viewer, float cosine, float sine) {
  const Vec3 along{cosine, sine, 0};
  return normalised(along - dot(along, viewer) * viewer);
}

// The network's output, not clamped, with the pixel's normal and noise given; the pixel must have a surface.
// The horizon form needs no other normal of the view. For training.
float evaluate_unclamped(const Network& network, const View& view, Vec3 normal, const Sampling& sampling,
                         std::uint32_t x, std::uint32_t y, TapNoise noise);

// Three units of a pixel with a surface, for pictures: the first of the paper's first layer; of the horizon
// form the first of the means over directions.
std::array<float, 3> first_units(const Network& network, const View& view, const Sampling& sampling,
                                 std::uint32_t x, std::uint32_t y);

// AO of one pixel in [0, 1]; exactly 1 where there is no surface.
float evaluate_pixel(const Network& network, const View& view, const Sampling& sampling, std::uint32_t x,
                     std::uint32_t y);

// All pixels of a view, in the order of its depths. Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) where sizes,
// radius or taps are out of range.
void evaluate(const Network& network, const View& view, const Sampling& sampling, std::span<float> ao);

}  // namespace nook::nnao
