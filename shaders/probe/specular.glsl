// Glossy reflection of a lobe by a GGX surface: the directions that it reflects to the eye, as an isotropic lobe
// (J. Wang et al. 2009) or an anisotropic one (K. Xu et al. 2013); the same as sdk/src/probe/specular.cpp.
#include "shaders/probe/ggx_reflection.glsl"
#include "shaders/probe/lobe.glsl"

// A surface seen from one direction, ready to reflect any number of lobes.
struct NookProbeReflection {
  vec3 x, y, z;     // z: the view mirrored in the mean normal that it sees; x and y: the axes of the anisotropic lobe
  vec2 sharpness;   // along x and y; the isotropic lobe's is in x
  float amplitude;  // of the lobe of integral 1
  float shading;    // directional albedo: masking and Fresnel
};

NookProbeReflection nook_probe_reflection_anisotropic(NookProbeSurface surface) {
  NookProbeReflection r;
  NookProbeSurfaceView view = nook_probe_view_of(surface);
  vec3 middle = nook_probe_mean_micro_normal(view, surface);
  r.z = reflect(-surface.view, middle);
  vec3 w = view.in_plane, right = cross(w, surface.normal);
  vec3 y = normalize(cross(r.z, right)), x = cross(y, r.z);
  vec2 widths = sqrt(nook_probe_lobe_widths(view));
  float across = 2.0 * max(dot(middle, surface.view), 1e-3) * widths.y, within = 2.0 * widths.x;
  vec2 along_x = vec2(dot(right, view.tangent), dot(right, view.bitangent)) / across;
  vec2 along_w = vec2(dot(w, view.tangent), dot(w, view.bitangent)) / within;
  vec2 s = 1.0 / (surface.alpha * surface.alpha);
  // The distribution's exponent as a quadratic form of the reflected direction's offset along x and y.
  float xx = dot(along_x * along_x, s);
  float xy = dot(along_x * along_w, s);
  float yy = dot(along_w * along_w, s);
  float mean = 0.5 * (xx + yy), spread = sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  // atan(0, 0) is not defined; any angle serves a round lobe.
  float angle = spread > 0.0 ? 0.5 * atan(2.0 * xy, xx - yy) : 0.0;
  float c = cos(angle), d = sin(angle);
  float product = s.x * s.y / (across * across * within * within);
  r.x = x * c + y * d;
  r.y = y * c - x * d;
  r.sharpness = vec2(mean + spread, product / (mean + spread));
  r.amplitude = 1.0 / nook_probe_lobe_integral(2.0 * sqrt(product));
  r.shading = nook_probe_directional_albedo(view, surface);
  return r;
}

// Returns the reflection of the surface with the geometric mean of both widths.
NookProbeReflection nook_probe_reflection_isotropic(NookProbeSurface surface) {
  surface.alpha = vec2(sqrt(surface.alpha.x * surface.alpha.y));
  NookProbeReflection r = nook_probe_reflection_anisotropic(surface);
  r.sharpness = vec2(2.0 * sqrt(r.sharpness.x * r.sharpness.y));
  return r;
}

vec3 nook_probe_lobe_specular_isotropic(NookLobe lobe, NookProbeReflection r) {
  return lobe.amplitude * (r.shading * r.amplitude *
                           nook_probe_lobe_product_integral(r.sharpness.x, lobe.sharpness,
                                                            nook_probe_apart(r.z, lobe.axis)));
}

vec3 nook_probe_lobe_specular_anisotropic(NookLobe lobe, NookProbeReflection r) {
  vec2 offset = vec2(dot(lobe.axis, r.x), dot(lobe.axis, r.y));
  float sine2 = dot(offset, offset);
  float apart = nook_probe_apart(lobe.axis, r.z);
  // As wide as it is towards the light. Straight behind every way is as far and the wider one counts, ever
  // more so from the horizon on.
  float behind = max(apart - 1.0, 0.0), turned = behind * behind;
  float wider = min(r.sharpness.x, r.sharpness.y);
  float towards = sine2 + turned > 1e-12
                      ? 2.0 * (dot(r.sharpness, offset * offset) + wider * turned) / (sine2 + turned)
                      : 2.0 * wider;
  float sum = towards + lobe.sharpness;
  float cross_term = 2.0 * towards * lobe.sharpness * apart;
  float product = sqrt(max(sum * sum - cross_term, 0.0));
  vec2 both = lobe.sharpness + 2.0 * r.sharpness;
  float sharpness = sqrt(both.x * both.y) * product / sum;
  return lobe.amplitude *
         (r.shading * r.amplitude * exp(-cross_term / (product + sum)) * nook_probe_lobe_integral(sharpness));
}
