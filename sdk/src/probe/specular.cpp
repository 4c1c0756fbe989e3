#include "probe/specular.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "probe/axes.h"

namespace nook::probe {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

// The warp's sharpness grows without bound at grazing views.
float facing(const Surface& surface) {
  return std::max(dot(surface.normal, surface.view), 1e-3f);
}

Vec3 mirrored(const Surface& surface) {
  return surface.normal * (2 * dot(surface.normal, surface.view)) - surface.view;
}

Vec3 across(const Surface& surface) {
  const Vec3 t = surface.tangent - surface.normal * dot(surface.normal, surface.tangent);
  return dot(t, t) > 1e-8f ? normalised(t) : frame_round(surface.normal).x;
}

// Smith's masking of one direction over twice its cosine: 1 / (n + sqrt(n^2 + alpha_x^2 x^2 + alpha_y^2
// y^2)).
float masking(const Surface& surface, Vec3 tangent, Vec3 direction) {
  const Vec3 bitangent = cross(surface.normal, tangent);
  const float n = std::max(dot(surface.normal, direction), 0.0f);
  const float x = surface.alpha_x * dot(tangent, direction), y = surface.alpha_y * dot(bitangent, direction);
  return 1 / std::max(n + std::sqrt(n * n + x * x + y * y), 1e-6f);
}

// Everything of the reflection but the distribution, at the lobe's centre.
float shading(const Surface& surface, Vec3 centre) {
  const Vec3 tangent = across(surface);
  const float cosine = std::max(dot(surface.normal, centre), 0.0f);
  const Vec3 half = normalised(centre + surface.view);
  const float away = 1 - std::clamp(dot(half, surface.view), 0.0f, 1.0f), away2 = away * away;
  const float fresnel = surface.reflectance + (1 - surface.reflectance) * away2 * away2 * away;
  return fresnel * masking(surface, tangent, centre) * masking(surface, tangent, surface.view) * cosine;
}

}  // namespace

SphericalGaussian warped_lobe(const Surface& surface) {
  const float alpha2 = surface.alpha_x * surface.alpha_y;
  const float height = 1 / (pi * alpha2);
  return {mirrored(surface), 2 / alpha2 / (4 * facing(surface)), {height, height, height}};
}

AnisotropicGaussian warped_anisotropic_lobe(const Surface& surface) {
  const Vec3 n = surface.normal, tangent = across(surface), bitangent = cross(n, tangent);
  const float cosine = facing(surface);
  const Vec3 in_plane = surface.view - n * dot(n, surface.view);
  // A half vector n + e w, w in the plane of incidence, reflects 2 e along `y`; n + e x, x across it,
  // reflects 2 e cosine along x.
  const bool tilted = dot(in_plane, in_plane) > 1e-8f;
  const Vec3 w = tilted ? normalised(in_plane) : tangent;
  const Vec3 x = cross(w, n), z = mirrored(surface);
  const Vec3 y = cross(z, x);
  const float xt = dot(x, tangent), xb = dot(x, bitangent), wt = dot(w, tangent), wb = dot(w, bitangent);
  const float st = 1 / (surface.alpha_x * surface.alpha_x), sb = 1 / (surface.alpha_y * surface.alpha_y);
  // The distribution's exponent as a quadratic form of the reflected direction's offset along x and y.
  const float xx = (xt * xt * st + xb * xb * sb) / (4 * cosine * cosine);
  const float xy = (xt * wt * st + xb * wb * sb) / (4 * cosine);
  const float yy = (wt * wt * st + wb * wb * sb) / 4;
  const float middle = (xx + yy) / 2, spread = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
  const float c = std::cos(angle), s = std::sin(angle);
  const float least = xx * yy - xy * xy;  // the product of both sharpnesses
  return {x * c + y * s,
          y * c - x * s,
          z,
          middle + spread,
          least / (middle + spread),
          1 / (pi * surface.alpha_x * surface.alpha_y)};
}

float product_integral(const AnisotropicGaussian& lobe, const SphericalGaussian& light) {
  const float x = dot(light.axis, lobe.x), y = dot(light.axis, lobe.y), sine2 = x * x + y * y;
  const float apart = one_minus_cosine(light.axis, lobe.z);
  // The lobe as wide as it is towards the light. Straight behind every way is as far and the wider one
  // counts, ever more so from the horizon on: otherwise a rough surface would show a pinch there.
  const float behind = std::max(apart - 1, 0.0f), turned = behind * behind;
  const float wider = std::min(lobe.x_sharpness, lobe.y_sharpness);
  const float towards =
      sine2 + turned > 1e-12f
          ? 2 * (lobe.x_sharpness * x * x + lobe.y_sharpness * y * y + wider * turned) / (sine2 + turned)
          : 2 * wider;
  const ProductShape<float> shape = gaussian_product_shape(towards, light.sharpness, apart);
  // Its integral shrinks with both widths.
  const float both =
      std::sqrt((light.sharpness + 2 * lobe.x_sharpness) * (light.sharpness + 2 * lobe.y_sharpness));
  const float sharpness = both * shape.sharpness / (towards + light.sharpness);
  return lobe.amplitude * shape.scale * gaussian_integral(sharpness);
}

Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface) {
  Vec3 sum;
  if (form == SpecularForm::isotropic) {
    const SphericalGaussian lobe = warped_lobe(surface);
    for (const SphericalGaussian& light : lights) sum += product_integral(lobe, light);
  } else {
    const AnisotropicGaussian lobe = warped_anisotropic_lobe(surface);
    for (const SphericalGaussian& light : lights) sum += light.amplitude * product_integral(lobe, light);
  }
  return sum * shading(surface, mirrored(surface));
}

}  // namespace nook::probe
