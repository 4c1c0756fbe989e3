// Functions for a host's shader. Directions are unit vectors in world space, like the probe's lobes; colours
// are linear RGB.
#include "shaders/probe/grid.glsl"
#include "shaders/probe/harmonics.glsl"
#include "shaders/probe/irradiance.glsl"
#include "shaders/probe/specular.glsl"

// Returns the radiance from a direction.
vec3 nook_probe_radiance(NookProbePlace place, vec3 direction) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i) sum += nook_sg_lobe_radiance(nook_probe_lobe_at(place, i), direction);
  return sum;
}

// Returns the irradiance on a surface. Fits of probes may ring slightly below 0; negative values are clamped.
vec3 nook_probe_irradiance(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i) sum += nook_sg_lobe_irradiance(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}
// These return the same by S. Hill's fit alone, and with the clamped cosine as a lobe.
vec3 nook_probe_irradiance_fitted(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_sg_lobe_irradiance_fitted(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}
vec3 nook_probe_irradiance_inner_product(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_sg_lobe_irradiance_inner_product(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}

// Returns the radiance that a GGX surface reflects to the eye. It reads the amplitudes for gloss, which are not
// negative. A probe without them reads the light's, and what falls below 0 is clamped.
vec3 nook_probe_specular_isotropic(NookProbePlace place, NookProbeSurface surface) {
  NookProbeReflection reflection = nook_probe_reflection_isotropic(surface);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_sg_lobe_specular_isotropic(nook_probe_gloss_lobe_at(place, i), reflection);
  return max(sum, 0.0);
}
vec3 nook_probe_specular_anisotropic(NookProbePlace place, NookProbeSurface surface) {
  NookProbeReflection reflection = nook_probe_reflection_anisotropic(surface);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_sg_lobe_specular_anisotropic(nook_probe_gloss_lobe_at(place, i), reflection);
  return max(sum, 0.0);
}

// Returns the radiance that a Lambertian surface reflects. occlusion is AO in all channels, or directional
// occlusion.
vec3 nook_probe_ambient(vec3 albedo, vec3 irradiance, vec3 occlusion) {
  return albedo * irradiance * occlusion * 0.31830989;
}

// Returns the share of a glossy reflection that AO leaves: AO for rough surfaces, and a smaller effect for
// sharper reflections (S. Lagarde, C. de Rousiers, Moving Frostbite to PBR, 2014). facing is dot(normal,
// view).
float nook_probe_specular_occlusion(float ao, float facing, float roughness) {
  return clamp(pow(max(facing, 0.0) + ao, exp2(-16.0 * roughness - 1.0)) - 1.0 + ao, 0.0, 1.0);
}
