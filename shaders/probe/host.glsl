// Functions for a host's shader. Pass directions as unit vectors in world space. Colours are linear RGB.
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

// Returns the irradiance on a surface. Ringing in a probe's fit may make it slightly negative; negative values
// are clamped to 0.
vec3 nook_probe_irradiance(NookProbePlace place, vec3 normal) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < place.lobe_count; ++i) sum += nook_sg_lobe_irradiance(nook_probe_lobe_at(place, i), normal);
  return max(sum, 0.0);
}
// These two functions return cheaper approximations of the irradiance. The first uses only S. Hill's fit. The
// second uses a lobe instead of the clamped cosine.
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

// Returns the radiance that a GGX surface reflects to the eye. It uses the amplitudes for gloss, which are
// never negative. If the probe does not have them, it uses the amplitudes of the light, and clamps negative
// results to 0.
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

// Returns the radiance that a Lambertian surface reflects. Pass directional occlusion as `occlusion`, or AO
// in all three channels.
vec3 nook_probe_ambient(vec3 albedo, vec3 irradiance, vec3 occlusion) {
  return albedo * irradiance * occlusion * 0.31830989;
}

// Estimates specular occlusion from AO. Returns the factor by which to multiply a glossy reflection. For
// rough surfaces, it equals AO. For sharper reflections, the effect is smaller (S. Lagarde, C. de Rousiers,
// Moving Frostbite to PBR, 2014). `facing` is dot(normal, view).
float nook_probe_specular_occlusion(float ao, float facing, float roughness) {
  return clamp(pow(max(facing, 0.0) + ao, exp2(-16.0 * roughness - 1.0)) - 1.0 + ao, 0.0, 1.0);
}
