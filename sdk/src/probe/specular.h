// Glossy reflection of lobes: the directions that a GGX surface reflects to the eye, as one lobe of integral
// 1, times the surface's directional albedo. Its product integral with each light lobe is closed.
#pragma once

#include <cstdint>
#include <span>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/core/vec.h"
#include "sdk/src/probe/ggx_reflection.h"

namespace nook::probe {

enum class SpecularForm : std::uint8_t {
  isotropic = 0,   // one spherical Gaussian (J. Wang et al., All-Frequency Rendering, 2009)
  anisotropic = 1  // an anisotropic one (K. Xu et al., Anisotropic Spherical Gaussians, 2013)
};

// amplitude exp(-x_sharpness u^2 - y_sharpness v^2), u and v the chord from z to the direction along x and y.
// Of u, v and the chord's square 2 (1 - cosine), Xu's form has sines instead, which fold the far hemisphere
// over the near one; with chords, equal sharpnesses l / 2 are the spherical Gaussian of sharpness l,
// everywhere.
struct AnisotropicGaussian {
  Vec3 x, y, z;
  float x_sharpness = 0;
  float y_sharpness = 0;
  float amplitude = 0;
};

// The reflected lobes of a surface, of integral 1. Both are the distribution of normals warped to reflected
// directions, not round the normal, as in the papers, but round the mean of the normals that the eye sees:
// near the horizon a rough surface reflects from far above the mirror direction.
SphericalGaussian warped_lobe(const Surface& surface);
AnisotropicGaussian warped_anisotropic_lobe(const Surface& surface);

// Integral of the product with a light, at its amplitude 1: exact where x_sharpness and y_sharpness are
// equal, and for constant light.
float product_integral(const AnisotropicGaussian& lobe, const SphericalGaussian& light);

// Radiance that leaves towards the eye.
Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface);

}  // namespace nook::probe
