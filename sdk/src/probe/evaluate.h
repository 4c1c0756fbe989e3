// Light of a probe: radiance from a direction, irradiance on a surface. Glossy reflection is in specular.h.
#pragma once

#include <nook/nook_probe.h>

#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/basis.h"

namespace nook::probe {

enum class IrradianceForm : std::uint8_t { fitted = 0, inner_product = 1, bands = 2 };

// Irradiance of one lobe of amplitude 1; see core/spherical_gaussian.h.
float irradiance(Vec3 axis, float sharpness, IrradianceForm form, Vec3 normal);

Vec3 radiance(std::span<const SphericalGaussian> lobes, Vec3 direction);
Vec3 irradiance(std::span<const SphericalGaussian> lobes, IrradianceForm form, Vec3 normal);

// The same for every kind of basis; form matters to lobes alone.
Vec3 radiance(const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction);
Vec3 irradiance(const Basis& basis, std::span<const Vec3> coefficients, IrradianceForm form, Vec3 normal);

}  // namespace nook::probe
