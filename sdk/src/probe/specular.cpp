#include "sdk/src/probe/specular.h"

#include <cmath>

namespace nook::probe {
namespace {

// The surface of equal widths that stands for this one.
Surface rounded(Surface surface) {
  surface.alpha_x = surface.alpha_y = std::sqrt(surface.alpha_x * surface.alpha_y);
  return surface;
}

Vec3 gathered(std::span<const SphericalGaussian> reflected, std::span<const SphericalGaussian> lights) {
  Vec3 sum;
  for (const SphericalGaussian& light : lights)
    for (const SphericalGaussian& lobe : reflected) sum += product_integral(lobe, light);
  return sum;
}

}  // namespace

SphericalGaussian reflected_lobe(const Surface& surface) {
  const Surface round = rounded(surface);
  const SurfaceView view = view_of(round);
  const VisibleNormal middle = middle_normal(view, round);
  SphericalGaussian lobe;
  reflect(view, round, {&middle, 1}, {&lobe, 1});
  return lobe;
}

std::array<SphericalGaussian, 4> reflected_lobes(const Surface& surface) {
  const SurfaceView view = view_of(surface);
  std::array<SphericalGaussian, 4> lobes;
  reflect(view, surface, visible_normals(view, surface), lobes);
  return lobes;
}

Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface) {
  if (form == SpecularForm::isotropic) {
    const Surface round = rounded(surface);
    const SphericalGaussian lobe = reflected_lobe(round);
    return gathered({&lobe, 1}, lights) * directional_albedo(view_of(round), round);
  }
  return gathered(reflected_lobes(surface), lights) * directional_albedo(view_of(surface), surface);
}

}  // namespace nook::probe
