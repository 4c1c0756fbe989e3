#include "sdk/src/probe/specular.h"

#include <algorithm>
#include <cmath>

namespace nook::probe {
namespace {

// The surface of equal widths whose lobe stands for this one's.
Surface rounded(Surface surface) {
  surface.alpha_x = surface.alpha_y = std::sqrt(surface.alpha_x * surface.alpha_y);
  return surface;
}

}  // namespace

SphericalGaussian warped_lobe(const Surface& surface) {
  const AnisotropicGaussian lobe = warped_anisotropic_lobe(rounded(surface));
  const float sharpness = 2 * std::sqrt(lobe.x_sharpness * lobe.y_sharpness);
  return {lobe.z, sharpness, {lobe.amplitude, lobe.amplitude, lobe.amplitude}};
}

AnisotropicGaussian warped_anisotropic_lobe(const Surface& surface) {
  const SurfaceView view = view_of(surface);
  const Vec3 half = mean_micro_normal(view, surface);
  const Vec3 z = half * (2 * dot(half, surface.view)) - surface.view;
  const Vec3 w = view.in_plane, right = cross(w, surface.normal);
  const Vec3 y = normalised(cross(z, right)), x = cross(y, z);
  // A normal that leans by e within the plane of incidence reflects 2 e along `y`; across it, 2 e times its
  // cosine to the view along `x`.
  const float cosine = std::max(dot(half, surface.view), 1e-3f);
  const LobeWidths width = lobe_widths(view);
  const float across = 2 * cosine * std::sqrt(width.across), within = 2 * std::sqrt(width.in_plane);
  const float xt = dot(right, view.tangent) / across, xb = dot(right, view.bitangent) / across;
  const float wt = dot(w, view.tangent) / within, wb = dot(w, view.bitangent) / within;
  const float st = 1 / (surface.alpha_x * surface.alpha_x), sb = 1 / (surface.alpha_y * surface.alpha_y);
  // The distribution's exponent as a quadratic form of the reflected direction's offset along x and y.
  const float xx = xt * xt * st + xb * xb * sb;
  const float xy = xt * wt * st + xb * wb * sb;
  const float yy = wt * wt * st + wb * wb * sb;
  const float middle = (xx + yy) / 2, spread = std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
  const float angle = 0.5f * std::atan2(2 * xy, xx - yy);
  const float c = std::cos(angle), s = std::sin(angle);
  const float product = st * sb / (across * across * within * within);  // of both sharpnesses
  return {x * c + y * s,
          y * c - x * s,
          z,
          middle + spread,
          product / (middle + spread),
          1 / gaussian_integral(2 * std::sqrt(product))};
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
  const Surface shaded = form == SpecularForm::isotropic ? rounded(surface) : surface;
  Vec3 sum;
  if (form == SpecularForm::isotropic) {
    const SphericalGaussian lobe = warped_lobe(shaded);
    for (const SphericalGaussian& light : lights) sum += product_integral(lobe, light);
  } else {
    const AnisotropicGaussian lobe = warped_anisotropic_lobe(shaded);
    for (const SphericalGaussian& light : lights) sum += light.amplitude * product_integral(lobe, light);
  }
  return sum * directional_albedo(view_of(shaded), shaded);
}

}  // namespace nook::probe
