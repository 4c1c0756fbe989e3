// Glossy reflection of lobes: the GGX distribution of normals, as a lobe of half vectors, is warped to the
// lobe of directions that it reflects to the eye; its product integral with each light lobe is closed.
// Masking, Fresnel and the cosine are taken at the lobe's centre.
#pragma once

#include <cstdint>
#include <span>

#include "core/spherical_gaussian.h"
#include "core/vec.h"

namespace nook::probe {

enum class SpecularForm : std::uint8_t {
  isotropic = 0,   // one spherical Gaussian (J. Wang et al., All-Frequency Rendering, 2009)
  anisotropic = 1  // an anisotropic one (K. Xu et al., Anisotropic Spherical Gaussians, 2013)
};

struct Surface {
  Vec3 normal{0, 0, 1};       // unit
  Vec3 view{0, 0, 1};         // unit, towards the eye
  Vec3 tangent{1, 0, 0};      // unit, across the normal; read where alpha_x and alpha_y differ
  float alpha_x = 0.25f;      // GGX width, roughness squared, along the tangent
  float alpha_y = 0.25f;      // across it; the isotropic form takes their geometric mean
  float reflectance = 0.04f;  // at normal incidence
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

// The reflected lobes of a surface; amplitude is the distribution's, without masking and Fresnel.
SphericalGaussian warped_lobe(const Surface& surface);
AnisotropicGaussian warped_anisotropic_lobe(const Surface& surface);

// Integral of the product with a light, at its amplitude 1: exact where x_sharpness and y_sharpness are
// equal.
float product_integral(const AnisotropicGaussian& lobe, const SphericalGaussian& light);

// Radiance that leaves towards the eye.
Vec3 specular(std::span<const SphericalGaussian> lights, SpecularForm form, const Surface& surface);

}  // namespace nook::probe
