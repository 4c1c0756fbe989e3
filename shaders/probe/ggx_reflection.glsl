// The reflection of a GGX surface as numbers that depend on the view alone, as in
// sdk/src/probe/ggx_reflection.h.
#include "shaders/probe/constants.h"

struct NookProbeSurface {
  vec3 normal;       // unit
  vec3 view;         // unit, from the surface to the eye
  vec3 tangent;      // unit, across the normal; counts where the two alphas differ
  vec2 alpha;        // GGX width, roughness squared, along the tangent and across it; 0.001 to 1
  float reflectance; // at normal incidence, 0 to 1
};

struct NookProbeSurfaceView {
  vec3 tangent, bitangent;
  vec3 in_plane;
  vec2 view;         // along tangent and bitangent
  float facing;
  vec2 alpha2;       // squared width of slopes in the plane of incidence and across it
  float openness;
  float roughness_in_plane;
};

NookProbeSurfaceView nook_probe_view_of(NookProbeSurface surface) {
  NookProbeSurfaceView v;
  vec3 n = surface.normal;
  vec3 t = surface.tangent - n * dot(n, surface.tangent);
  if (dot(t, t) <= 1e-8) t = cross(n, abs(n.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0));
  v.tangent = normalize(t);
  v.bitangent = cross(n, v.tangent);
  v.view = vec2(dot(surface.view, v.tangent), dot(surface.view, v.bitangent));
  v.facing = max(dot(n, surface.view), 1e-3);
  float sine2 = dot(v.view, v.view);
  vec2 w = sine2 > 1e-8 ? v.view / sqrt(sine2) : vec2(1.0, 0.0);
  vec2 a2 = surface.alpha * surface.alpha;
  v.in_plane = v.tangent * w.x + v.bitangent * w.y;
  v.alpha2 = vec2(dot(w * w, a2), dot(w.yx * w.yx, a2));
  v.openness = v.facing / sqrt(v.facing * v.facing + sine2 * v.alpha2.x);
  v.roughness_in_plane = sqrt(sqrt(min(v.alpha2.x * pow(v.alpha2.x / v.alpha2.y, 0.1), 1.0)));
  return v;
}

// Polynomials of two variables: sums of k u^i v^j over i + j <= degree, j fastest.
float nook_probe_albedo_polynomial(float u, float v) {
  return NOOK_GGX_ALBEDO_0 + v * (NOOK_GGX_ALBEDO_1 + v * (NOOK_GGX_ALBEDO_2 + v * (NOOK_GGX_ALBEDO_3 + v * NOOK_GGX_ALBEDO_4))) +
         u * (NOOK_GGX_ALBEDO_5 + v * (NOOK_GGX_ALBEDO_6 + v * (NOOK_GGX_ALBEDO_7 + v * NOOK_GGX_ALBEDO_8)) +
              u * (NOOK_GGX_ALBEDO_9 + v * (NOOK_GGX_ALBEDO_10 + v * NOOK_GGX_ALBEDO_11) + u * (NOOK_GGX_ALBEDO_12 + v * NOOK_GGX_ALBEDO_13 + u * NOOK_GGX_ALBEDO_14)));
}
float nook_probe_fresnel_polynomial(float u, float v) {
  return NOOK_GGX_FRESNEL_0 + v * (NOOK_GGX_FRESNEL_1 + v * (NOOK_GGX_FRESNEL_2 + v * (NOOK_GGX_FRESNEL_3 + v * NOOK_GGX_FRESNEL_4))) +
         u * (NOOK_GGX_FRESNEL_5 + v * (NOOK_GGX_FRESNEL_6 + v * (NOOK_GGX_FRESNEL_7 + v * NOOK_GGX_FRESNEL_8)) +
              u * (NOOK_GGX_FRESNEL_9 + v * (NOOK_GGX_FRESNEL_10 + v * NOOK_GGX_FRESNEL_11) + u * (NOOK_GGX_FRESNEL_12 + v * NOOK_GGX_FRESNEL_13 + u * NOOK_GGX_FRESNEL_14)));
}
float nook_probe_tilt_polynomial(float u, float v) {
  return NOOK_GGX_TILT_0 + v * (NOOK_GGX_TILT_1 + v * NOOK_GGX_TILT_2) + u * (NOOK_GGX_TILT_3 + v * NOOK_GGX_TILT_4 + u * NOOK_GGX_TILT_5);
}
float nook_probe_width_polynomial(float u, float v) {
  return NOOK_GGX_WIDTH_0 + v * (NOOK_GGX_WIDTH_1 + v * NOOK_GGX_WIDTH_2) + u * (NOOK_GGX_WIDTH_3 + v * NOOK_GGX_WIDTH_4 + u * NOOK_GGX_WIDTH_5);
}

// Share of uniform light that leaves towards the eye.
float nook_probe_directional_albedo(NookProbeSurfaceView v, NookProbeSurface surface) {
  float mean2 = 0.5 * (v.alpha2.x + v.alpha2.y), away = 1.0 - v.facing;
  float alpha2 = mean2 - 0.5 * away * away * away * (v.alpha2.x - mean2);
  float whole = clamp(nook_probe_albedo_polynomial(v.openness, sqrt(clamp(alpha2, 0.0, 1.0))), 0.0, 1.0);
  float rho = v.roughness_in_plane;
  float off = clamp(1.0 - v.facing - rho * nook_probe_fresnel_polynomial(sqrt(v.facing), rho), 0.0, 1.0);
  float off2 = off * off;
  return whole * (surface.reflectance + (1.0 - surface.reflectance) * off2 * off2 * off);
}

// The mean normal, weighed by what it reflects.
vec3 nook_probe_mean_micro_normal(NookProbeSurfaceView v, NookProbeSurface surface) {
  float lean = max(nook_probe_tilt_polynomial(v.openness, v.roughness_in_plane), 0.0) / ((1.0 + v.facing) * v.alpha2.x);
  vec2 slope = lean * surface.alpha * surface.alpha * v.view;
  return normalize(surface.normal + v.tangent * slope.x + v.bitangent * slope.y);
}

// Squared widths of the lobe over those of slopes, in the plane of incidence and across it.
vec2 nook_probe_lobe_widths(NookProbeSurfaceView v) {
  vec2 rho = sqrt(sqrt(v.alpha2));
  float wider = NOOK_GGX_WIDER_0 + rho.y * NOOK_GGX_WIDER_1 + v.facing * NOOK_GGX_WIDER_2;
  return vec2(nook_probe_width_polynomial(v.facing, rho.x),
              nook_probe_width_polynomial(v.facing, rho.y) + (1.0 - v.facing) * wider);
}
