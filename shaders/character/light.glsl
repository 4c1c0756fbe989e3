// The light of an instance, and how spheres occlude it. The formulas are derived in
// sdk/src/character/directional_occlusion.h.
#include "shaders/core/constants.h"
#include "shaders/character/instance.glsl"
#include "shaders/character/light_layout.h"
#include "shaders/probe/lobe.glsl"

// Returns texel i of a light in the stream. light_layout.h lists the texels.
vec4 nook_light(uint light, int i) { return nook_streamed(light + uint(i)); }
// Returns the first of the two texels of a lobe.
int nook_lobe_texel(int lobe) { return NOOK_LIGHT_LOBES + NOOK_LIGHT_LOBE_TEXELS * lobe; }

float nook_lobe_norm(float v) {
  float q = (((NOOK_LOBE_NORM_4 * v + NOOK_LOBE_NORM_3) * v + NOOK_LOBE_NORM_2) * v + NOOK_LOBE_NORM_1) * v + NOOK_LOBE_NORM_0;
  return q / (v * q + 1.0);
}

// Returns the mean radiance of the lobes, weighted by the density exp(dot(b, s)). Light that the ground hides
// is not included.
vec3 nook_mean_radiance(uint light, vec3 b) {
  float length_b = length(b);
  int count = int(nook_light(light, NOOK_LIGHT_HEAD).x);
  vec3 sum = vec3(0.0);
  for (int i = 0; i < count; ++i) {
    int lobe = nook_lobe_texel(i);
    vec4 shape = nook_light(light, lobe), amplitude = nook_light(light, lobe + 1);
    float m = length(b + shape.xyz * shape.w);
    sum += exp(min(m - (length_b + shape.w), 0.0)) * nook_lobe_norm(m) * amplitude.w * amplitude.xyz;
  }
  return sum / nook_lobe_norm(length_b);
}

vec3 nook_inverse_hemisphere(uint light, vec3 n) {
  return 1.0 / max(nook_mean_radiance(light, n * NOOK_COSINE_LOBE_SHARPNESS), nook_light(light, NOOK_LIGHT_DARKEST).xyz);
}

// The unit vector towards the part of a caster that is above the horizon, and the cosine between this vector
// and the normal.
struct NookSight {
  vec3 towards;
  float cosine;
};

NookSight nook_sight(vec3 n, vec3 o) {
  float xi = dot(o, n), delta2 = dot(o, o);
  float height = max(xi, 0.5 * max(xi, -1.0) + 0.5);
  float inverse_distance = inversesqrt(max(delta2 + height * height - xi * xi, 1e-12));
  return NookSight((o + n * (height - xi)) * inverse_distance, height * inverse_distance);
}

float nook_concentration(NookSight sight, float f, float concentration) {
  float height = max(sight.cosine, 1e-12), f2 = f * f;
  return concentration * max(1.0 - f2, 0.0) * (height * inversesqrt(height * f2));
}

vec3 nook_light_ratio(uint light, vec3 inverse, vec3 n, NookSight sight, float share, float sharpest) {
  float k = min(nook_concentration(sight, max(share, NOOK_SMALLEST_SHARE), NOOK_CASTER_CONCENTRATION), sharpest);
  vec3 behind = nook_mean_radiance(light, n * NOOK_COSINE_LOBE_SHARPNESS + sight.towards * k);
  return clamp(behind * inverse, 0.0, NOOK_LARGEST_RATIO);
}

// Returns the share of a lobe that is below the horizon. `m` is the sharpness of the lobe, and `height` is
// the height of its vector above the horizon.
float nook_share_below(float height, float m) {
  float x = height * inversesqrt(m * 2.0 * m / (m + 4.0) + NOOK_BELOW_WIDTH), a = abs(x);
  float p = (((NOOK_BELOW_4 * a + NOOK_BELOW_3) * a + NOOK_BELOW_2) * a + NOOK_BELOW_1) * a + 1.0;
  float p2 = min(p * p, 1e9), tail = 0.5 / (p2 * p2);
  return x < 0.0 ? 1.0 - tail : tail;
}

vec3 nook_ground_ratio(uint light, vec3 n) {
  float h = NOOK_COSINE_LOBE_SHARPNESS;
  vec3 b = n * h, up = nook_light(light, NOOK_LIGHT_HEAD).yzw, all = vec3(0.0), below = vec3(0.0);
  int count = int(nook_light(light, NOOK_LIGHT_HEAD).x);
  for (int i = 0; i < count; ++i) {
    int lobe = nook_lobe_texel(i);
    vec4 shape = nook_light(light, lobe);
    vec3 amplitude = nook_light(light, lobe + 1).xyz, v = b + shape.xyz * shape.w;
    float m = length(v);
    vec3 seen = exp(min(m - (h + shape.w), 0.0)) * nook_lobe_norm(m) * amplitude;
    all += seen;
    below += seen * nook_share_below(dot(v, up), m);
  }
  vec3 inverse = 1.0 / (max(all, nook_lobe_norm(h) * nook_light(light, NOOK_LIGHT_DARKEST).xyz) * nook_share_below(dot(b, up), h));
  return clamp(below * inverse, 0.0, NOOK_LARGEST_RATIO);
}

// The densities of spheres, summed in bands 0 to 2.
struct NookBands {
  float scalar;
  vec3 vector, straight, mixed;  // straight: xx, yy, zz; mixed: xy, yz, zx
};

void nook_gather(inout NookBands bands, vec3 b, float weight) {
  float t = inversesqrt(max(dot(b, b), 1.0));
  float a1 = 1.0 - t, a2 = 1.0 - 3.0 * t * a1;
  vec3 d = b * t;
  bands.scalar += weight;
  bands.vector += weight * a1 * d;
  bands.straight += weight * a2 * d * d;
  bands.mixed += weight * a2 * d * d.yzx;
}

vec3 nook_light_of(uint light, NookBands bands) {
  vec3 sum = bands.scalar * nook_light(light, NOOK_LIGHT_SCALAR).xyz;
  for (int i = 0; i < 3; ++i)
    sum += bands.vector[i] * nook_light(light, NOOK_LIGHT_VECTOR + i).xyz + bands.straight[i] * nook_light(light, NOOK_LIGHT_STRAIGHT + i).xyz +
           bands.mixed[i] * nook_light(light, NOOK_LIGHT_MIXED + i).xyz;
  return sum;
}

// Returns the sum of the terms of the spheres, each multiplied by the relative light that its sphere removes.
vec3 nook_coloured_sum(uint light, NookBands gathered, vec3 n) {
  NookBands open = NookBands(0.0, vec3(0.0), vec3(0.0), vec3(0.0));
  nook_gather(open, n * NOOK_COSINE_LOBE_SHARPNESS, 1.0);
  vec3 ratio = nook_light_of(light, gathered) / max(nook_light_of(light, open), nook_light(light, NOOK_LIGHT_DARKEST).xyz);
  vec3 bounded = clamp(ratio, 0.0, NOOK_LARGEST_RATIO * gathered.scalar);
  return NOOK_SELF_STRENGTH * bounded + (1.0 - NOOK_SELF_STRENGTH) * gathered.scalar;
}
