// The reflection of a rough dielectric or metal as files of physically based materials mean it: GGX and
// Schlick's Fresnel term over a Lambertian part (glTF 2.0 specification, appendix B), with Smith's masking
// correlated by height (E. Heitz, Understanding the Masking-Shadowing Function, JCGT 2014), as engines have
// it.
#pragma once

#include "sdk/src/core/vec.h"

namespace nook::bake::material {

inline constexpr float dielectric_reflectance = 0.04f;  // at normal incidence
// Smoother surfaces shine as this one: their highlights would fall between sampled directions.
inline constexpr float least_roughness = 0.1f;

// Returns the GGX width of a perceptual roughness of 0 to 1: its square, from least_roughness on.
float ggx_width(float roughness);

struct Reflector {
  Vec3 diffuse;      // linear RGB, already without the share of metal
  Vec3 reflectance;  // at normal incidence, linear RGB
  float width = 1;   // of GGX
};

// Returns pi times the BRDF, so that a white Lambertian surface gives 1. Unit vectors away from the surface,
// the light above it; a view below 3 degrees counts as one at 3 degrees.
Vec3 microfacet_reflection(const Reflector& surface, Vec3 normal, Vec3 view, Vec3 light);

}  // namespace nook::bake::material
