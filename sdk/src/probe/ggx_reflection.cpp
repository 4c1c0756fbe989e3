#include "sdk/src/probe/ggx_reflection.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/probe/axes.h"
#include "shaders/probe/constants.h"

namespace nook::probe {
namespace {

// Evaluates a polynomial: the sum of k u^i v^j over i + j <= degree, where j varies fastest.
template <int degree>
float polynomial(const double (&k)[(degree + 1) * (degree + 2) / 2], float u, float v) {
  int at = (degree + 1) * (degree + 2) / 2;
  float sum = 0;
  for (int i = degree; i >= 0; --i) {
    float row = 0;
    for (int j = degree - i; j >= 0; --j) row = row * v + float(k[--at]);
    sum = sum * u + row;
  }
  return sum;
}

constexpr double albedo_k[] = {NOOK_GGX_ALBEDO_0, NOOK_GGX_ALBEDO_1,
                               NOOK_GGX_ALBEDO_2};  // polynomial of openness and alpha
constexpr double fresnel_k[] = {NOOK_GGX_FRESNEL_0, NOOK_GGX_FRESNEL_1,
                                NOOK_GGX_FRESNEL_2};  // polynomial of the square roots of facing and of alpha
// Polynomials of openness and the square root of alpha.
constexpr double middle_along_k[] = {NOOK_GGX_MIDDLE_ALONG};
constexpr double middle_sharpness_k[] = {NOOK_GGX_MIDDLE_SHARPNESS};
constexpr double near_along_k[] = {NOOK_GGX_NEAR_ALONG};
constexpr double near_share_k[] = {NOOK_GGX_NEAR_SHARE};
constexpr double near_sharpness_k[] = {NOOK_GGX_NEAR_SHARPNESS};
constexpr double far_along_k[] = {NOOK_GGX_FAR_ALONG};
constexpr double far_share_k[] = {NOOK_GGX_FAR_SHARE};
constexpr double far_sharpness_k[] = {NOOK_GGX_FAR_SHARPNESS};
constexpr double pair_across_k[] = {NOOK_GGX_PAIR_ACROSS};
constexpr double pair_along_k[] = {NOOK_GGX_PAIR_ALONG};
constexpr double pair_sharpness_k[] = {NOOK_GGX_PAIR_SHARPNESS};

// Returns the square root of the alpha that the isotropic form uses instead of both widths.
float mean_roughness(const Surface& surface) {
  return std::sqrt(std::sqrt(surface.alpha_x * surface.alpha_y));
}

// Returns a visible normal in the stretched space, where the distribution of slopes is isotropic, as a unit
// vector. In this space, the view has the component `flat` along the plane of incidence and `openness`
// upwards.
Vec3 among_round_slopes(const SurfaceView& view, float across, float along) {
  // Moves the point inside the rim of the disc, because normals at the rim reflect along the horizon.
  const float shrink = std::min(1.0f, 0.99f / std::max(std::hypot(across, along), 1e-6f));
  const float a = shrink * across, lifted = 0.5f + 0.5f * view.openness;
  const float b = (1 - lifted) * std::sqrt(1 - a * a) + lifted * shrink * along;
  const float c = std::sqrt(std::max(1 - a * a - b * b, 0.0f));
  const float flat = std::sqrt(std::max(1 - view.openness * view.openness, 0.0f));
  return {a, c * flat - b * view.openness, b * flat + c * view.openness};
}

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
  view.alpha2_in_plane = x * x * x2 + y * y * y2;
  view.alpha2_across = y * y * x2 + x * x * y2;
  view.stretched_x = surface.alpha_x * x / std::sqrt(view.alpha2_in_plane);
  view.stretched_y = surface.alpha_y * y / std::sqrt(view.alpha2_in_plane);
  view.openness = view.facing / std::sqrt(view.facing * view.facing + sine2 * view.alpha2_in_plane);
  // If the width of the slopes across the plane of incidence is large, fewer normals are tilted far within
  // the plane.
  const float alpha2 = view.alpha2_in_plane * std::pow(view.alpha2_in_plane / view.alpha2_across, 0.1f);
  view.roughness_in_plane = std::sqrt(std::sqrt(std::min(alpha2, 1.0f)));
  return view;
}

float directional_albedo(const SurfaceView& view, const Surface& surface) {
  // Computes the albedo of a surface that reflects all light. It uses the isotropic width for which masking
  // between the slopes removes the same amount of light.
  const float mean2 = 0.5f * (view.alpha2_in_plane + view.alpha2_across);
  const float away = 1 - view.facing;
  const float alpha2 = mean2 - 0.5f * away * away * away * (view.alpha2_in_plane - mean2);
  const float whole = std::clamp(
      polynomial<4>(albedo_k, view.openness, std::sqrt(std::clamp(alpha2, 0.0f, 1.0f))), 0.0f, 1.0f);
  // Evaluates the Fresnel term at one cosine between normal and view. There, the term equals its mean over
  // the normals.
  const float rho = view.roughness_in_plane;
  const float cosine = view.facing + rho * polynomial<4>(fresnel_k, std::sqrt(view.facing), rho);
  const float off = std::clamp(1 - cosine, 0.0f, 1.0f), off2 = off * off;
  return whole * (surface.reflectance + (1 - surface.reflectance) * off2 * off2 * off);
}

VisibleNormal middle_normal(const SurfaceView& view, const Surface& surface) {
  const float u = view.openness, rho = mean_roughness(surface);
  return {0, polynomial<2>(middle_along_k, u, rho), 1, polynomial<2>(middle_sharpness_k, u, rho)};
}

std::array<VisibleNormal, 4> visible_normals(const SurfaceView& view, const Surface& surface) {
  const float u = view.openness, rho = mean_roughness(surface);
  const float across = polynomial<2>(pair_across_k, u, rho), along = polynomial<2>(pair_along_k, u, rho);
  const float sharpness = polynomial<2>(pair_sharpness_k, u, rho);
  return {{{0, polynomial<2>(near_along_k, u, rho), polynomial<2>(near_share_k, u, rho),
            polynomial<2>(near_sharpness_k, u, rho)},
           {0, polynomial<2>(far_along_k, u, rho), polynomial<2>(far_share_k, u, rho),
            polynomial<2>(far_sharpness_k, u, rho)},
           {across, along, 1, sharpness},
           {-across, along, 1, sharpness}}};
}

void reflect(const SurfaceView& view, const Surface& surface, std::span<const VisibleNormal> normals,
             std::span<SphericalGaussian> lobes) {
  const float ax = surface.alpha_x, ay = surface.alpha_y;
  const Vec3 eye{view.view_x, view.view_y, view.facing};
  const float masked = view.facing / view.openness;  // square root of facing^2 + (slopes towards the eye)^2
  float all = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 slopes = among_round_slopes(view, normals[i].across, normals[i].along);
    const Vec3 whole{ax * (slopes.y * view.stretched_x - slopes.x * view.stretched_y),
                     ay * (slopes.y * view.stretched_y + slopes.x * view.stretched_x), slopes.z};
    const float length2 = dot(whole, whole);
    const Vec3 l = whole * (2 * dot(whole, eye) / length2) - eye;
    const float up = std::max(l.z, 0.0f);
    const float hidden = std::sqrt(up * up + ax * ax * l.x * l.x + ay * ay * l.y * l.y);
    const float masking = up * (view.facing + masked) / (view.facing * hidden + up * masked);
    const float weight = std::max(normals[i].share, 0.0f) * std::max(masking, 1e-6f);
    // The density of reflected directions is the density of visible normals divided by four times the cosine.
    const float sharpness =
        std::max(normals[i].sharpness, 0.2f) * length2 * length2 / (ax * ay * (view.facing + masked));
    lobes[i] = {normalised(view.tangent * l.x + view.bitangent * l.y + surface.normal * l.z),
                sharpness,
                {weight, weight, weight}};
    all += weight;
  }
  for (SphericalGaussian& lobe : lobes)
    lobe.amplitude = lobe.amplitude * (1 / (all * gaussian_integral(lobe.sharpness)));
}

}  // namespace nook::probe
