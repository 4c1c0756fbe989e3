// Glossy reflection of a lobe by a GGX surface. The directions from which the surface reflects light to the
// eye are approximated by one lobe or by four lobes, which are stored in the components of vec4.
// sdk/src/probe/probe_light.cpp has the same functions.
#include "shaders/probe/ggx_reflection.glsl"
#include "shaders/probe/lobe.glsl"

// The reflection of a surface that is seen from one direction. You can evaluate it for any number of light
// lobes.
struct NookProbeReflection {
  vec4 x, y, z;     // axes of the four lobes, unit vectors
  vec4 sharpness;
  vec4 amplitude;   // amplitudes of the lobes, whose integrals sum to the directional albedo, which includes
                    // masking and Fresnel
};

// Returns four integrals at once; see nook_sg_integral.
vec4 nook_probe_four_integrals(vec4 x) {
  vec4 series = 2.0 - x * (2.0 - x * (1.3333333 - 0.6666667 * x));
  return 6.2831853 * mix((1.0 - exp(-2.0 * x)) / max(x, 1e-6), series, lessThan(x, vec4(0.05)));
}

NookProbeReflection nook_probe_reflection_of(NookProbeSurface surface, NookProbeSurfaceView v, NookProbeVisibleNormals normals) {
  // In the stretched space, the view has the component `flat_` along the plane of incidence and v.openness
  // upwards.
  float flat_ = sqrt(max(1.0 - v.openness * v.openness, 0.0)), lifted = 0.5 + 0.5 * v.openness;
  vec4 shrink = min(vec4(1.0), 0.99 / max(sqrt(normals.across * normals.across + normals.along * normals.along), 1e-6));
  vec4 a = shrink * normals.across;
  vec4 b = (1.0 - lifted) * sqrt(1.0 - a * a) + lifted * shrink * normals.along;
  vec4 c = sqrt(max(1.0 - a * a - b * b, 0.0));
  vec4 along = c * flat_ - b * v.openness;
  vec4 hx = surface.alpha.x * (along * v.stretched.x - a * v.stretched.y);
  vec4 hy = surface.alpha.y * (along * v.stretched.y + a * v.stretched.x);
  vec4 hz = b * flat_ + c * v.openness;
  vec4 length2 = hx * hx + hy * hy + hz * hz;
  vec4 twice = 2.0 * (hx * v.view.x + hy * v.view.y + hz * v.facing) / length2;
  vec4 lx = hx * twice - v.view.x, ly = hy * twice - v.view.y, lz = hz * twice - v.facing;
  vec4 up = max(lz, 0.0), sx = surface.alpha.x * lx, sy = surface.alpha.y * ly;
  float masked = v.facing / v.openness;
  vec4 masking = up * (v.facing + masked) / (v.facing * sqrt(up * up + sx * sx + sy * sy) + up * masked);
  vec4 weight = max(normals.share, 0.0) * max(masking, 1e-6);
  vec4 scale = inversesqrt(lx * lx + ly * ly + lz * lz);
  NookProbeReflection r;
  r.x = scale * (v.tangent.x * lx + v.bitangent.x * ly + surface.normal.x * lz);
  r.y = scale * (v.tangent.y * lx + v.bitangent.y * ly + surface.normal.y * lz);
  r.z = scale * (v.tangent.z * lx + v.bitangent.z * ly + surface.normal.z * lz);
  // The density of reflected directions is the density of visible normals divided by four times the cosine.
  r.sharpness = max(normals.sharpness, 0.2) * length2 * length2 / (surface.alpha.x * surface.alpha.y * (v.facing + masked));
  r.amplitude = weight * nook_probe_directional_albedo(v, surface) / (dot(weight, vec4(1.0)) * nook_probe_four_integrals(r.sharpness));
  return r;
}

NookProbeReflection nook_probe_reflection_anisotropic(NookProbeSurface surface) {
  NookProbeSurfaceView view = nook_probe_view_of(surface);
  return nook_probe_reflection_of(surface, view, nook_probe_visible_normals(view, surface));
}

// Returns the reflection of a surface with the geometric mean of both widths. Only the first lobe is used.
NookProbeReflection nook_probe_reflection_isotropic(NookProbeSurface surface) {
  surface.alpha = vec2(sqrt(surface.alpha.x * surface.alpha.y));
  NookProbeSurfaceView view = nook_probe_view_of(surface);
  return nook_probe_reflection_of(surface, view, nook_probe_middle_normal(view, surface));
}

vec3 nook_sg_lobe_specular_isotropic(NookLobe lobe, NookProbeReflection r) {
  float apart = nook_probe_apart(vec3(r.x.x, r.y.x, r.z.x), lobe.axis);
  return lobe.amplitude * (r.amplitude.x * nook_sg_product_integral(r.sharpness.x, lobe.sharpness, apart));
}

vec3 nook_sg_lobe_specular_anisotropic(NookLobe lobe, NookProbeReflection r) {
  vec4 dx = r.x - lobe.axis.x, dy = r.y - lobe.axis.y, dz = r.z - lobe.axis.z;
  vec4 sum = r.sharpness + lobe.sharpness;
  vec4 cross_term = r.sharpness * lobe.sharpness * (dx * dx + dy * dy + dz * dz);
  vec4 sharpness = sqrt(max(sum * sum - cross_term, 0.0));
  vec4 product = exp(-cross_term / (sharpness + sum)) * nook_probe_four_integrals(sharpness);
  return lobe.amplitude * dot(r.amplitude, product);
}
