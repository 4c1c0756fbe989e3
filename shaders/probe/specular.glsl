// Glossy reflection of a lobe by a GGX surface: the distribution of normals warped to reflected directions, as
// an isotropic lobe (J. Wang et al. 2009) or an anisotropic one (K. Xu et al. 2013); the same as
// sdk/src/probe/specular.cpp.
#include "probe/lobe.glsl"

struct NookProbeSurface {
  vec3 normal;       // unit
  vec3 view;         // unit, from the surface to the eye
  vec3 tangent;      // unit, across the normal; counts where the two alphas differ
  vec2 alpha;        // GGX width, roughness squared, along the tangent and across it; 0.001 to 1
  float reflectance; // at normal incidence, 0 to 1
};

// A surface seen from one direction, ready to reflect any number of lobes.
struct NookProbeReflection {
  vec3 x, y, z;     // z: the mirrored view; x and y: the axes of the anisotropic lobe
  vec2 sharpness;   // along x and y; the isotropic lobe's is in x
  float amplitude;  // of the lobe
  float shading;    // masking, Fresnel and cosine at its centre
};

// Smith's masking of one direction over twice its cosine.
float nook_probe_masking(NookProbeSurface surface, vec3 tangent, vec3 direction) {
  vec3 bitangent = cross(surface.normal, tangent);
  float n = max(dot(surface.normal, direction), 0.0);
  vec2 t = surface.alpha * vec2(dot(tangent, direction), dot(bitangent, direction));
  return 1.0 / max(n + sqrt(n * n + dot(t, t)), 1e-6);
}

vec3 nook_probe_across(NookProbeSurface surface) {
  vec3 n = surface.normal;
  vec3 t = surface.tangent - n * dot(n, surface.tangent);
  if (dot(t, t) <= 1e-8) t = cross(n, abs(n.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0));
  return normalize(t);
}

float nook_probe_shading(NookProbeSurface surface, vec3 tangent, vec3 centre) {
  vec3 middle = normalize(centre + surface.view);
  float away = 1.0 - clamp(dot(middle, surface.view), 0.0, 1.0), away2 = away * away;
  float fresnel = surface.reflectance + (1.0 - surface.reflectance) * away2 * away2 * away;
  return fresnel * nook_probe_masking(surface, tangent, centre) *
         nook_probe_masking(surface, tangent, surface.view) * max(dot(surface.normal, centre), 0.0);
}

NookProbeReflection nook_probe_reflection_isotropic(NookProbeSurface surface) {
  NookProbeReflection r;
  vec3 tangent = nook_probe_across(surface);
  float alpha2 = surface.alpha.x * surface.alpha.y;
  float facing = max(dot(surface.normal, surface.view), 1e-3);
  r.z = reflect(-surface.view, surface.normal);
  r.x = tangent;
  r.y = cross(r.z, r.x);
  r.sharpness = vec2(2.0 / alpha2 / (4.0 * facing));
  r.amplitude = 1.0 / (3.14159265 * alpha2);
  r.shading = nook_probe_shading(surface, tangent, r.z);
  return r;
}

vec3 nook_probe_lobe_specular_isotropic(NookLobe lobe, NookProbeReflection r) {
  return lobe.amplitude * (r.shading * r.amplitude *
                           nook_probe_lobe_product_integral(r.sharpness.x, lobe.sharpness,
                                                            nook_probe_apart(r.z, lobe.axis)));
}

NookProbeReflection nook_probe_reflection_anisotropic(NookProbeSurface surface) {
  NookProbeReflection r;
  vec3 n = surface.normal, tangent = nook_probe_across(surface), bitangent = cross(n, tangent);
  float facing = max(dot(n, surface.view), 1e-3);
  vec3 in_plane = surface.view - n * dot(n, surface.view);
  vec3 w = dot(in_plane, in_plane) > 1e-8 ? normalize(in_plane) : tangent;
  vec3 x = cross(w, n);
  r.z = reflect(-surface.view, n);
  vec3 y = cross(r.z, x);
  vec2 along_x = vec2(dot(x, tangent), dot(x, bitangent)), along_w = vec2(dot(w, tangent), dot(w, bitangent));
  vec2 s = 1.0 / (surface.alpha * surface.alpha);
  // The distribution's exponent as a quadratic form of the reflected direction's offset along x and y.
  float xx = dot(along_x * along_x, s) / (4.0 * facing * facing);
  float xy = dot(along_x * along_w, s) / (4.0 * facing);
  float yy = dot(along_w * along_w, s) / 4.0;
  float middle = 0.5 * (xx + yy), spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  // atan(0, 0) is not defined; any angle serves a round lobe.
  float angle = spread > 0.0 ? 0.5 * atan(2.0 * xy, xx - yy) : 0.0;
  float c = cos(angle), d = sin(angle);
  r.x = x * c + y * d;
  r.y = y * c - x * d;
  r.sharpness = vec2(middle + spread, (xx * yy - xy * xy) / (middle + spread));
  r.amplitude = 1.0 / (3.14159265 * surface.alpha.x * surface.alpha.y);
  r.shading = nook_probe_shading(surface, tangent, r.z);
  return r;
}

vec3 nook_probe_lobe_specular_anisotropic(NookLobe lobe, NookProbeReflection r) {
  float nu = 0.5 * lobe.sharpness;
  vec2 s = nu * r.sharpness / (nu + r.sharpness);
  vec2 offset = vec2(dot(lobe.axis, r.x), dot(lobe.axis, r.y));
  float apart = nook_probe_apart(lobe.axis, r.z);
  float sine2 = dot(offset, offset);
  float exponent = sine2 > 1e-12 ? dot(s, offset * offset) * 2.0 * apart / sine2 : 2.0 * apart * min(s.x, s.y);
  float sharpness = 2.0 * sqrt((nu + r.sharpness.x) * (nu + r.sharpness.y));
  return lobe.amplitude * (r.shading * r.amplitude * nook_probe_lobe_integral(sharpness) * exp(-exponent));
}
