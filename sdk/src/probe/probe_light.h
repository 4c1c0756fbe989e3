// Light of a probe: radiance from a direction, irradiance on a surface, glossy reflection.
#pragma once

#include <nook/nook_probe.h>

#include <cstdint>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/basis.h"
#include "sdk/src/probe/ggx_reflection.h"

namespace nook::probe {

enum class IrradianceForm : std::uint8_t { fitted = 0, inner_product = 1, bands = 2 };

// Returns the irradiance of one lobe of amplitude 1; see core/spherical_gaussian.h.
float irradiance(Vec3 axis, float sharpness, IrradianceForm form, Vec3 normal);

Vec3 radiance(std::span<const SphericalGaussian> lobes, Vec3 direction);
Vec3 irradiance(std::span<const SphericalGaussian> lobes, IrradianceForm form, Vec3 normal);

// The same for every kind of basis; form matters only for lobes.
Vec3 radiance(const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction);
Vec3 irradiance(const Basis& basis, std::span<const Vec3> coefficients, IrradianceForm form, Vec3 normal);

// Glossy reflection of lobes. The directions that a GGX surface reflects to the eye become lobes with
// integral 1 together, times the surface's directional albedo. Product integrals with each light lobe have a
// closed form.

enum class SpecularForm : std::uint8_t {
  isotropic = 0,   // one spherical Gaussian, after J. Wang et al., All-Frequency Rendering, 2009
  anisotropic = 1  // four
};

// Returns the lobe that a surface of the mean width reflects to the eye. In the paper, it is the distribution
// of normals, warped around the mirror direction. Here it is around the centre of what the eye sees, because
// near the horizon a rough surface reflects from far above the mirror direction.
SphericalGaussian reflected_lobe(const Surface& surface);
// Returns four lobes, which stretch towards the horizon and if the widths differ.
std::array<SphericalGaussian, 4> reflected_lobes(const Surface& surface);

// Returns the radiance that leaves towards the eye.
Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface);

}  // namespace nook::probe
