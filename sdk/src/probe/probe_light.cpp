#include "sdk/src/probe/probe_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

// Computes the irradiance of each function of the basis on a surface, at coefficient 1.
void irradiance_functions(const Basis& basis, IrradianceForm form, Vec3 normal, float* values) {
  switch (basis.kind) {
    case BasisKind::gaussians:
      for (std::uint32_t i = 0; i < basis.count; ++i)
        values[i] = irradiance(basis.axis[i], basis.sharpness[i], form, normal);
      return;
    case BasisKind::harmonics:
      evaluate_harmonics(basis.order, normal.x, normal.y, normal.z, values);
      for (std::uint32_t l = 0, i = 0; l <= basis.order; ++l)
        for (; i < harmonic_count(l); ++i) values[i] *= float(cosine_band[l]);
      return;
    case BasisKind::dice:
      for (std::uint32_t i = 0; i < basis.count; ++i) values[i] = dice_irradiance(dot(basis.axis[i], normal));
      return;
  }
}

Vec3 weighted(const Basis& basis, std::span<const Vec3> coefficients, const float* values) {
  Vec3 sum;
  for (std::uint32_t i = 0; i < basis.count; ++i) sum += coefficients[i] * values[i];
  return sum;
}

}  // namespace

float irradiance(Vec3 axis, float sharpness, IrradianceForm form, Vec3 normal) {
  switch (form) {
    case IrradianceForm::inner_product:
      return gaussian_irradiance_inner_product(axis, sharpness, normal);
    case IrradianceForm::fitted:
      return gaussian_integral(sharpness) * gaussian_unit_irradiance_fitted(sharpness, dot(axis, normal));
    case IrradianceForm::bands:
      return gaussian_integral(sharpness) * gaussian_unit_irradiance_best(sharpness, dot(axis, normal));
  }
  return 0;
}

Vec3 radiance(std::span<const SphericalGaussian> lobes, Vec3 direction) {
  Vec3 sum;
  for (const SphericalGaussian& lobe : lobes) sum += value(lobe, direction);
  return sum;
}

Vec3 irradiance(std::span<const SphericalGaussian> lobes, IrradianceForm form, Vec3 normal) {
  Vec3 sum;
  for (const SphericalGaussian& lobe : lobes)
    sum += lobe.amplitude * irradiance(lobe.axis, lobe.sharpness, form, normal);
  return sum;
}

Vec3 radiance(const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction) {
  std::array<float, max_functions> values;
  evaluate_basis(basis, direction, values.data());
  return weighted(basis, coefficients, values.data());
}

Vec3 irradiance(const Basis& basis, std::span<const Vec3> coefficients, IrradianceForm form, Vec3 normal) {
  std::array<float, max_functions> values;
  irradiance_functions(basis, form, normal, values.data());
  return weighted(basis, coefficients, values.data());
}

namespace {

// Returns a surface with equal widths, which the isotropic form uses instead of this one.
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
