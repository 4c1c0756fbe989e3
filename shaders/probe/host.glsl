// What a host's shader calls. Directions are unit vectors, world space as the probe's lobes; colours linear RGB.
#include "shaders/probe/grid.glsl"
#include "shaders/probe/harmonics.glsl"
#include "shaders/probe/irradiance.glsl"
#include "shaders/probe/specular.glsl"

// Radiance from a direction.
vec3 nook_probe_radiance(NookProbePlace place, vec3 direction) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i) sum += nook_probe_lobe_radiance(nook_probe_lobe_at(place, i), direction);
  return sum;
}

// Irradiance on a surface; fits of probes may ring a little below 0, which is cut off.
vec3 nook_probe_irradiance(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i) sum += nook_probe_lobe_irradiance(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}
// The same by S. Hill's fit alone, and with the clamped cosine as a lobe.
vec3 nook_probe_irradiance_fitted(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_probe_lobe_irradiance_fitted(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}
vec3 nook_probe_irradiance_inner_product(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_probe_lobe_irradiance_inner_product(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}

// Radiance that a GGX surface sends to the eye.
vec3 nook_probe_specular_isotropic(NookProbePlace place, NookProbeSurface surface) {
  NookProbeReflection reflection = nook_probe_reflection_isotropic(surface);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_probe_lobe_specular_isotropic(nook_probe_lobe_at(place, i), reflection);
  return max(sum, 0.0);
}
vec3 nook_probe_specular_anisotropic(NookProbePlace place, NookProbeSurface surface) {
  NookProbeReflection reflection = nook_probe_reflection_anisotropic(surface);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i)
    sum += nook_probe_lobe_specular_anisotropic(nook_probe_lobe_at(place, i), reflection);
  return max(sum, 0.0);
}

// What a Lambertian surface sends back; occlusion is AO in all channels, or a directional occlusion.
vec3 nook_probe_ambient(vec3 albedo, vec3 irradiance, vec3 occlusion) {
  return albedo * irradiance * occlusion * 0.31830989;
}

// Share of a glossy reflection that AO leaves: as AO for rough surfaces, and the less of it the sharper the
// reflection (S. Lagarde, C. de Rousiers, Moving Frostbite to PBR, 2014); facing is dot(normal, view).
float nook_probe_specular_occlusion(float ao, float facing, float roughness) {
  return clamp(pow(max(facing, 0.0) + ao, exp2(-16.0 * roughness - 1.0)) - 1.0 + ao, 0.0, 1.0);
}
