#include "sdk/src/probe/ggx_reflection.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/probe/axes.h"
#include "shaders/probe/constants.h"

namespace nook::probe {
namespace {

// Sum of k u^i v^j over i + j <= degree, j fastest.
template <int degree>
float polynomial(const float (&k)[(degree + 1) * (degree + 2) / 2], float u, float v) {
  int at = (degree + 1) * (degree + 2) / 2;
  float sum = 0;
  for (int i = degree; i >= 0; --i) {
    float row = 0;
    for (int j = degree - i; j >= 0; --j) row = row * v + k[--at];
    sum = sum * u + row;
  }
  return sum;
}

// A polynomial of openness and alpha.
constexpr float albedo_k[15] = {
    float(NOOK_GGX_ALBEDO_0),  float(NOOK_GGX_ALBEDO_1),  float(NOOK_GGX_ALBEDO_2),
    float(NOOK_GGX_ALBEDO_3),  float(NOOK_GGX_ALBEDO_4),  float(NOOK_GGX_ALBEDO_5),
    float(NOOK_GGX_ALBEDO_6),  float(NOOK_GGX_ALBEDO_7),  float(NOOK_GGX_ALBEDO_8),
    float(NOOK_GGX_ALBEDO_9),  float(NOOK_GGX_ALBEDO_10), float(NOOK_GGX_ALBEDO_11),
    float(NOOK_GGX_ALBEDO_12), float(NOOK_GGX_ALBEDO_13), float(NOOK_GGX_ALBEDO_14)};
// A polynomial of the square roots of facing and of alpha.
constexpr float fresnel_k[15] = {
    float(NOOK_GGX_FRESNEL_0),  float(NOOK_GGX_FRESNEL_1),  float(NOOK_GGX_FRESNEL_2),
    float(NOOK_GGX_FRESNEL_3),  float(NOOK_GGX_FRESNEL_4),  float(NOOK_GGX_FRESNEL_5),
    float(NOOK_GGX_FRESNEL_6),  float(NOOK_GGX_FRESNEL_7),  float(NOOK_GGX_FRESNEL_8),
    float(NOOK_GGX_FRESNEL_9),  float(NOOK_GGX_FRESNEL_10), float(NOOK_GGX_FRESNEL_11),
    float(NOOK_GGX_FRESNEL_12), float(NOOK_GGX_FRESNEL_13), float(NOOK_GGX_FRESNEL_14)};
// A polynomial of openness and the square root of alpha.
constexpr float tilt_k[6] = {float(NOOK_GGX_TILT_0), float(NOOK_GGX_TILT_1), float(NOOK_GGX_TILT_2),
                             float(NOOK_GGX_TILT_3), float(NOOK_GGX_TILT_4), float(NOOK_GGX_TILT_5)};
// Polynomials of facing and the square root of alpha.
constexpr float width_k[6] = {float(NOOK_GGX_WIDTH_0), float(NOOK_GGX_WIDTH_1), float(NOOK_GGX_WIDTH_2),
                              float(NOOK_GGX_WIDTH_3), float(NOOK_GGX_WIDTH_4), float(NOOK_GGX_WIDTH_5)};
constexpr float wider_k[3] = {float(NOOK_GGX_WIDER_0), float(NOOK_GGX_WIDER_1), float(NOOK_GGX_WIDER_2)};

}  // namespace

SurfaceView view_of(const Surface& surface) {
  SurfaceView view;
  const Vec3 n = surface.normal, t = surface.tangent - n * dot(n, surface.tangent);
  view.tangent = dot(t, t) > 1e-8f ? normalised(t) : frame_round(n).x;
  view.bitangent = cross(n, view.tangent);
  view.view_x = dot(surface.view, view.tangent);
  view.view_y = dot(surface.view, view.bitangent);
  view.facing = std::max(dot(n, surface.view), 1e-3f);
  const float sine2 = view.view_x * view.view_x + view.view_y * view.view_y;
  const bool tilted = sine2 > 1e-8f;
  const float x = tilted ? view.view_x / std::sqrt(sine2) : 1,
              y = tilted ? view.view_y / std::sqrt(sine2) : 0;
  const float x2 = surface.alpha_x * surface.alpha_x, y2 = surface.alpha_y * surface.alpha_y;
  view.in_plane = view.tangent * x + view.bitangent * y;
  view.alpha2_in_plane = x * x * x2 + y * y * y2;
  view.alpha2_across = y * y * x2 + x * x * y2;
  view.openness = view.facing / std::sqrt(view.facing * view.facing + sine2 * view.alpha2_in_plane);
  // Wide slopes across the plane leave fewer normals that lean far within it.
  const float alpha2 = view.alpha2_in_plane * std::pow(view.alpha2_in_plane / view.alpha2_across, 0.1f);
  view.roughness_in_plane = std::sqrt(std::sqrt(std::min(alpha2, 1.0f)));
  return view;
}

float directional_albedo(const SurfaceView& view, const Surface& surface) {
  // Of a surface that reflects everything, at the isotropic width that loses as much between its slopes.
  const float mean2 = 0.5f * (view.alpha2_in_plane + view.alpha2_across);
  const float away = 1 - view.facing;
  const float alpha2 = mean2 - 0.5f * away * away * away * (view.alpha2_in_plane - mean2);
  const float whole = std::clamp(
      polynomial<4>(albedo_k, view.openness, std::sqrt(std::clamp(alpha2, 0.0f, 1.0f))), 0.0f, 1.0f);
  // Fresnel at the cosine between normals and view that has its mean.
  const float rho = view.roughness_in_plane;
  const float cosine = view.facing + rho * polynomial<4>(fresnel_k, std::sqrt(view.facing), rho);
  const float off = std::clamp(1 - cosine, 0.0f, 1.0f), off2 = off * off;
  return whole * (surface.reflectance + (1 - surface.reflectance) * off2 * off2 * off);
}

Vec3 mean_micro_normal(const SurfaceView& view, const Surface& surface) {
  const float lean = std::max(polynomial<2>(tilt_k, view.openness, view.roughness_in_plane), 0.0f) /
                     ((1 + view.facing) * view.alpha2_in_plane);
  // Slopes lean towards the view as far as they are wide: out of the plane of incidence, where one width
  // exceeds the other.
  return normalised(surface.normal + view.tangent * (lean * surface.alpha_x * surface.alpha_x * view.view_x) +
                    view.bitangent * (lean * surface.alpha_y * surface.alpha_y * view.view_y));
}

LobeWidths lobe_widths(const SurfaceView& view) {
  const float in_plane = std::sqrt(std::sqrt(view.alpha2_in_plane));
  const float across = std::sqrt(std::sqrt(view.alpha2_across));
  // Seen straight on, both are one function of the width of slopes in their direction.
  return {polynomial<2>(width_k, view.facing, in_plane),
          polynomial<2>(width_k, view.facing, across) +
              (1 - view.facing) * polynomial<1>(wider_k, view.facing, across)};
}

}  // namespace nook::probe
