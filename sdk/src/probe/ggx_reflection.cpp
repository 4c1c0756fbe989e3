#include "sdk/src/probe/ggx_reflection.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/probe/axes.h"

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
constexpr float albedo_k[15] = {0.944055f,   -0.13538f, -0.571832f, 0.749777f, -0.360353f,
                                -0.0303299f, 0.485681f, -2.26075f,  0.96185f,  -0.134767f,
                                0.886719f,   0.706674f, -0.411119f, -1.14826f, 0.620676f};
// A polynomial of the square roots of facing and of alpha.
constexpr float fresnel_k[15] = {0.108191f, 2.83018f,  -4.61656f, 2.03889f,  0.108505f,
                                 -1.35554f, 0.268952f, 6.32566f,  -4.83581f, 0.906918f,
                                 -7.91908f, 4.70353f,  2.07866f,  0.151807f, -1.00017f};
// A polynomial of openness and the square root of alpha.
constexpr float tilt_k[6] = {0.110059f, -0.14709f, 1.09911f, 0.00187069f, -0.124211f, -0.105623f};
// Polynomials of facing and the square root of alpha.
constexpr float width_k[6] = {4.75539f, -8.25312f, 3.73913f, -0.619576f, 0.570814f, 0.0648816f};
constexpr float wider_k[3] = {2.23813f, -2.03077f, -0.103893f};

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
