// The parts of a GGX surface's reflection that depend only on the view. sdk/src/probe/ggx_reflection.h has the
// same functions.
#include "shaders/probe/constants.h"

struct NookProbeSurface {
  vec3 normal;       // unit
  vec3 view;         // unit, from the surface to the eye
  vec3 tangent;      // unit, perpendicular to the normal; used only if the two alphas differ
  vec2 alpha;        // GGX width along the tangent and along the bitangent, which is the squared roughness;
                     // 0.001 to 1
  float reflectance; // at normal incidence, 0 to 1
};

struct NookProbeSurfaceView {
  vec3 tangent, bitangent;
  vec2 view;         // along tangent and bitangent
  vec2 stretched;    // direction of the plane of incidence in the space where slopes are isotropic, a unit vector
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
  v.alpha2 = vec2(dot(w * w, a2), dot(w.yx * w.yx, a2));
  v.stretched = surface.alpha * w / sqrt(v.alpha2.x);
  v.openness = v.facing / sqrt(v.facing * v.facing + sine2 * v.alpha2.x);
  v.roughness_in_plane = sqrt(sqrt(min(v.alpha2.x * pow(v.alpha2.x / v.alpha2.y, 0.1), 1.0)));
  return v;
}

// Evaluates polynomials of two variables: sums of k u^i v^j over i + j <= degree, j fastest.
float nook_probe_quadratic(float u, float v, float k0, float k1, float k2, float k3, float k4, float k5) {
  return k0 + v * (k1 + v * k2) + u * (k3 + v * k4 + u * k5);
}
float nook_probe_quartic(float u, float v, float k0, float k1, float k2, float k3, float k4, float k5, float k6, float k7,
                         float k8, float k9, float k10, float k11, float k12, float k13, float k14) {
  return k0 + v * (k1 + v * (k2 + v * (k3 + v * k4))) +
         u * (k5 + v * (k6 + v * (k7 + v * k8)) + u * (k9 + v * (k10 + v * k11) + u * (k12 + v * k13 + u * k14)));
}

// Returns the fraction of uniform light that the surface reflects towards the eye.
float nook_probe_directional_albedo(NookProbeSurfaceView v, NookProbeSurface surface) {
  float mean2 = 0.5 * (v.alpha2.x + v.alpha2.y), away = 1.0 - v.facing;
  float alpha = sqrt(clamp(mean2 - 0.5 * away * away * away * (v.alpha2.x - mean2), 0.0, 1.0));
  float whole = clamp(nook_probe_quartic(v.openness, alpha, NOOK_GGX_ALBEDO_0, NOOK_GGX_ALBEDO_1, NOOK_GGX_ALBEDO_2), 0.0, 1.0);
  float rho = v.roughness_in_plane;
  float cosine = v.facing + rho * nook_probe_quartic(sqrt(v.facing), rho, NOOK_GGX_FRESNEL_0, NOOK_GGX_FRESNEL_1, NOOK_GGX_FRESNEL_2);
  float off = clamp(1.0 - cosine, 0.0, 1.0), off2 = off * off;
  return whole * (surface.reflectance + (1.0 - surface.reflectance) * off2 * off2 * off);
}

// Four visible normals, one in each component. sdk/src/probe/ggx_reflection.h describes the fields.
struct NookProbeVisibleNormals {
  vec4 across, along, share, sharpness;
};

// Returns the square root of the alpha with which the isotropic form replaces both widths.
float nook_probe_mean_roughness(NookProbeSurface surface) { return sqrt(sqrt(surface.alpha.x * surface.alpha.y)); }

NookProbeVisibleNormals nook_probe_visible_normals(NookProbeSurfaceView v, NookProbeSurface surface) {
  float u = v.openness, rho = nook_probe_mean_roughness(surface);
  float across = nook_probe_quadratic(u, rho, NOOK_GGX_PAIR_ACROSS);
  float sharpness = nook_probe_quadratic(u, rho, NOOK_GGX_PAIR_SHARPNESS);
  NookProbeVisibleNormals all;
  all.across = vec4(0.0, 0.0, across, -across);
  all.along = vec4(nook_probe_quadratic(u, rho, NOOK_GGX_NEAR_ALONG), nook_probe_quadratic(u, rho, NOOK_GGX_FAR_ALONG),
                   vec2(nook_probe_quadratic(u, rho, NOOK_GGX_PAIR_ALONG)));
  all.share = vec4(nook_probe_quadratic(u, rho, NOOK_GGX_NEAR_SHARE), nook_probe_quadratic(u, rho, NOOK_GGX_FAR_SHARE), 1.0, 1.0);
  all.sharpness = vec4(nook_probe_quadratic(u, rho, NOOK_GGX_NEAR_SHARPNESS),
                       nook_probe_quadratic(u, rho, NOOK_GGX_FAR_SHARPNESS), vec2(sharpness));
  return all;
}

// Returns the normal for a single lobe in the first component. The other normals have no weight.
NookProbeVisibleNormals nook_probe_middle_normal(NookProbeSurfaceView v, NookProbeSurface surface) {
  float u = v.openness, rho = nook_probe_mean_roughness(surface);
  return NookProbeVisibleNormals(vec4(0.0), vec4(nook_probe_quadratic(u, rho, NOOK_GGX_MIDDLE_ALONG)), vec4(1.0, 0.0, 0.0, 0.0),
                                 vec4(nook_probe_quadratic(u, rho, NOOK_GGX_MIDDLE_SHARPNESS)));
}
