// Evaluates the light of a probe: the radiance from a direction, the irradiance on a surface, and glossy
// reflection.
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

// These functions accept every kind of basis. `form` is used only for lobes.
Vec3 radiance(const Basis& basis, std::span<const Vec3> coefficients, Vec3 direction);
Vec3 irradiance(const Basis& basis, std::span<const Vec3> coefficients, IrradianceForm form, Vec3 normal);

// Glossy reflection of lobes. A GGX surface reflects light from many directions to the eye. The distribution
// of these directions is approximated by lobes, too. The integrals of these lobes sum to 1. The lobes are
// multiplied by the surface's directional albedo. The integral of the product of such a lobe and a lobe of
// the light has a closed form.

enum class SpecularForm : std::uint8_t {
  isotropic = 0,   // one lobe, after J. Wang et al., All-Frequency Rendering, 2009
  anisotropic = 1  // four lobes
};

// Returns one lobe for the directions from which a surface reflects light to the eye. It uses the mean of
// both widths. In the paper, this lobe is the distribution of normals, warped around the mirror direction. In
// this function, the axis of the lobe is the mean of the reflected directions instead. The two axes differ
// near the horizon, where a rough surface reflects light from far above the mirror direction.
SphericalGaussian reflected_lobe(const Surface& surface);
// Returns four lobes. Together they can represent stretched reflections, which occur near the horizon and if
// the two widths differ.
std::array<SphericalGaussian, 4> reflected_lobes(const Surface& surface);

// Returns the radiance that the surface reflects to the eye.
Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface);

}  // namespace nook::probe
