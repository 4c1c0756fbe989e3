// Evaluates a network on the CPU, one pixel at a time. The result is raw AO, before the filter. Tests compare
// the OpenGL pass with it, and the training reports the errors of this evaluation. View space is the same as
// in OpenGL. Row 0 is at the bottom.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "sdk/src/core/vec.h"
#include "sdk/src/nnao/frame_radius.h"
#include "sdk/src/nnao/network.h"
#include "sdk/src/nnao/taps.h"

namespace nook::nnao {

// The mapping from pixels to view space. At depth w = -z, a perspective projection has
//   x = (x_scale px + x_offset) w, y = (y_scale py + y_offset) w,
// and an orthographic projection has the same equations without the factor w. px and py are pixel
// coordinates; the centre of pixel (0, 0) is at (0.5, 0.5).
struct ScreenRays {
  float x_scale = 1, x_offset = 0, y_scale = 1, y_offset = 0;
  bool orthographic = false;
};

// Derives the mapping from an OpenGL projection matrix (column-major), which may be off-centre, and the size
// of the screen. The result does not depend on the depth range of the projection, or on whether depth is
// reversed.
ScreenRays screen_rays(const float (&projection)[16], std::uint32_t width, std::uint32_t height);

inline Vec3 view_position(const ScreenRays& rays, float px, float py, float depth) {
  const float w = rays.orthographic ? 1 : depth;
  return {(rays.x_scale * px + rays.x_offset) * w, (rays.y_scale * py + rays.y_offset) * w, -depth};
}

inline PixelScale pixel_scale(const ScreenRays& rays, float depth) {
  const float w = rays.orthographic ? 1 : depth;
  return {1 / (rays.x_scale * w), 1 / (rays.y_scale * w)};
}

inline Vec3 to_viewer(const ScreenRays& rays, Vec3 position) {
  return rays.orthographic ? Vec3{0, 0, 1} : normalised(-position);
}

struct View {
  std::uint32_t width = 0, height = 0;
  ScreenRays rays;
  std::span<const float> depth;  // -z, metres; infinity or NaN for the sky and the far plane
  std::span<const Vec3> normal;  // unit length, facing the viewer

  bool has_surface(std::uint32_t x, std::uint32_t y) const { return std::isfinite(depth[at(x, y)]); }
  std::size_t at(std::uint32_t x, std::uint32_t y) const { return std::size_t(y) * width + x; }
};

// The depth, in metres, at which the sky is treated as a surface. This depth is far beyond any radius, and
// its square does not overflow a float.
inline constexpr float sky_depth = 1e15f;

// Returns the depth of a pixel. Coordinates outside the screen are clamped to the nearest pixel.
inline float depth_near(const View& view, int x, int y) {
  const auto column = std::uint32_t(std::clamp(x, 0, int(view.width) - 1)),
             row = std::uint32_t(std::clamp(y, 0, int(view.height) - 1));
  return view.has_surface(column, row) ? view.depth[view.at(column, row)] : sky_depth;
}

struct Sampling {
  float radius = 1;                   // metres
  float max_radius_px = 256;          // a radius that covers more pixels is reduced to this
  std::uint32_t taps = default_taps;  // horizon form: a count that horizon_grid accepts; paper form: 1 to 961
  float min_radius_px = 0;            // a radius that covers fewer pixels is enlarged to this; at most
                                      // max_radius_px
  DistanceFade fade = {};
};

// The clamped radius at one pixel, and the factor by which the pixel's darkness (1 - AO) is multiplied. If
// the minimum enlarges the radius, an occluder darkens more pixels. The factor then keeps the total darkness
// the same. The factor also contains the fade with distance.
struct PixelRadius {
  float metres = 0, px = 0, share = 1;
};
inline PixelRadius pixel_radius(const Sampling& sampling, PixelScale scale, float depth) {
  const float per_metre = std::abs(scale.y), wanted = sampling.radius * per_metre;
  const float px = std::min(std::max(wanted, sampling.min_radius_px), sampling.max_radius_px);
  return {px / per_metre, px, std::min(wanted / px, 1.0f) * sampling.fade.share(depth)};
}

struct TappedTexel {
  bool surface = false;  // the tap is on the screen and does not hit the sky
  std::uint32_t x = 0, y = 0;
};
TappedTexel tapped_texel(const View& view, std::uint32_t x, std::uint32_t y, TapOffset offset);
// Returns the texel of the screen that is nearest to the tap.
TappedTexel clamped_texel(const View& view, std::uint32_t x, std::uint32_t y, TapOffset offset);

using HorizonTapInput = std::array<float, HorizonNetwork::tap_inputs>;
HorizonTapInput horizon_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal,
                                  Vec3 viewer, float radius);

// Returns the distance of a pixel from the nearest border of the screen, divided by the radius, but at most
// 1.
inline float border_distance(const View& view, std::uint32_t x, std::uint32_t y, float radius_px) {
  const float across = float(std::min(x, view.width - 1 - x)), up = float(std::min(y, view.height - 1 - y));
  return std::min((std::min(across, up) + 0.5f) / radius_px, 1.0f);
}

// Computes the input of a tap in the paper's form. Returns false if all inputs are 0.
bool paper_tap_input(const View& view, TappedTexel texel, Vec3 position, Vec3 normal, float radius,
                     std::array<float, PaperNetwork::tap_inputs>& input);

// Returns the unit vector perpendicular to the direction to the viewer, in the plane of a screen direction.
inline Vec3 across_viewer(Vec3 viewer, float cosine, float sine) {
  const Vec3 along{cosine, sine, 0};
  return normalised(along - dot(along, viewer) * viewer);
}

// The output of the network for one pixel.
struct Openness {
  float ao = 1;      // not clamped
  Vec3 bent_normal;  // view space, unit length; the paper's form returns the normal
};

// Returns the network's outputs for a pixel with the given normal and noise. The pixel must show a surface.
// The horizon form does not read view.normal. The training uses this function.
Openness evaluate_openness(const Network& network, const View& view, Vec3 normal, const Sampling& sampling,
                           std::uint32_t x, std::uint32_t y, TapNoise noise);

// Returns Openness::ao of evaluate_openness.
float evaluate_unclamped(const Network& network, const View& view, Vec3 normal, const Sampling& sampling,
                         std::uint32_t x, std::uint32_t y, TapNoise noise);

// Returns three units for debug images. In the paper's form, they are the first units of the first layer; in
// the horizon form, the first units of the mean over directions. The pixel must show a surface.
std::array<float, 3> first_units(const Network& network, const View& view, const Sampling& sampling,
                                 std::uint32_t x, std::uint32_t y);

// Returns the AO of one pixel in [0, 1]. Where there is no surface, it is exactly 1.
float evaluate_pixel(const Network& network, const View& view, const Sampling& sampling, std::uint32_t x,
                     std::uint32_t y);

// Evaluates all pixels of a view and writes AO in the same order as view.depth. Throws
// Failure(NOOK_ERROR_INVALID_ARGUMENT) if sizes, radius or taps are out of range.
void evaluate(const Network& network, const View& view, const Sampling& sampling, std::span<float> ao);

}  // namespace nook::nnao
