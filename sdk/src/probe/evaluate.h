// Light of a probe: radiance from a direction, irradiance on a surface, glossy reflection.
#pragma once

#include <nook/nook_probe.h>

#include <span>

#include "core/spherical_gaussian.h"
#include "core/vec.h"
#include "probe/basis.h"

namespace nook::probe {

enum class IrradianceForm : std::uint8_t { fitted = 0, inner_product = 1 };

Vec3 radiance(std::span<const SphericalGaussian> lobes, Vec3 direction);
Vec3 irradiance(std::span<const SphericalGaussian> lobes, IrradianceForm form, Vec3 normal);

// The same for every kind of basis; form matters to lobes alone.
Vec3 radiance(const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction);
Vec3 irradiance(const Basis& basis, std::span<const Vec3> coefficients, IrradianceForm form, Vec3 normal);

enum class SpecularForm : std::uint8_t { isotropic = 0, anisotropic = 1 };

struct Surface {
  Vec3 normal;            // unit
  Vec3 view;              // unit, towards the eye
  Vec3 tangent;           // unit, across the normal; read where alpha_x and alpha_y differ
  float alpha_x = 0.25f;  // GGX width, roughness squared, along the tangent
  float alpha_y = 0.25f;
  float reflectance = 0.04f;  // at normal incidence
};

// Radiance that leaves towards the eye.
Vec3 specular(std::span<const SphericalGaussian> lobes, SpecularForm form, const Surface& surface);

}  // namespace nook::probe
