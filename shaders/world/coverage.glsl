// Computes the share of the cosine-weighted hemisphere above a point that a capsule covers. Formulas and
// names are as in sdk/src/world/coverage.h, which has the derivation.
#include "shaders/world/constants.h"

float nook_angle_of_versine(float w) {
  float x = abs(1.0 - w);
  float r = sqrt(max(min(w, 2.0 - w), 0.0)) *
            (((NOOK_ARC_3 * x + NOOK_ARC_2) * x + NOOK_ARC_1) * x + NOOK_ARC_0);
  return w > 1.0 ? 3.14159265 - r : r;
}

float nook_angle_of_cosine(float cosine) {
  return nook_angle_of_versine(1.0 - clamp(cosine, -1.0, 1.0));
}

// Phi = x u + y v.
vec2 nook_hull_factor(float su, float sv, float spread) {
  float s2 = max(spread * (2.0 - spread), NOOK_SMALLEST_SPREAD);
  float inverse_s = inversesqrt(s2);
  float inverse_s2 = inverse_s * inverse_s;
  float s = s2 * inverse_s;
  float difference = su - sv;
  float alpha = (spread * sv + difference) * inverse_s2;
  float beta = (spread * su - difference) * inverse_s2;
  float across2 = alpha * su + beta * sv;
  float gamma = sqrt(max(1.0 - across2, 0.0));
  float cu = sqrt(1.0 - su * su), cv = sqrt(1.0 - sv * sv);
  float apart = difference * (su + sv) / (cu + cv);
  float versine = (spread - 0.5 * (difference * difference + apart * apart)) / (cu * cv);
  if (versine > 1.0 && across2 > 1.0) return vec2(alpha, beta) * inversesqrt(across2);
  float lambda = nook_angle_of_versine(clamp(versine, 0.0, 2.0));
  float phi_u = nook_angle_of_cosine(beta * s / cu), phi_v = nook_angle_of_cosine(alpha * s / cv);
  return vec2(lambda * alpha + phi_u * su * su + gamma * s * beta,
              lambda * beta + phi_v * sv * sv + gamma * s * alpha) * 0.318309886;
}

float nook_above_horizon(float factor, float size2, float lowest) {
  float inverse_size = inversesqrt(max(size2, 1e-20));
  float size = min(size2 * inverse_size, 1.0);
  float height = factor * sqrt(inverse_size) * inverse_size;
  if (!(height > -1.0)) return 0.0;
  float t = clamp(max(height, lowest), -1.0, 1.0);
  float b = sqrt(1.0 - size), q = 1.0 - t * t;
  float w1 = b * (b * (b * NOOK_HORIZON_12 + NOOK_HORIZON_11) + NOOK_HORIZON_10);
  float w2 = b * (b * (b * NOOK_HORIZON_22 + NOOK_HORIZON_21) + NOOK_HORIZON_20);
  return max(size * sqrt(size) * (0.5 * (1.0 - t) - q * (w2 * q + w1)) + factor, 0.0);
}

// Pass the ends of the capsule with their radii, and a point with its unit normal, all in the same space.
// Returns the share in [0, 1], and writes the vector of the region to `phi`.
float nook_world_coverage(vec4 end_a, vec4 end_b, vec3 point, vec3 normal, out vec3 phi) {
  vec3 a = end_a.xyz - point, b = end_b.xyz - point;
  float ia = inversesqrt(max(dot(a, a), 1e-24)), ib = inversesqrt(max(dot(b, b), 1e-24));
  float su = min(end_a.w * ia, NOOK_LARGEST_SINE), sv = min(end_b.w * ib, NOOK_LARGEST_SINE);
  vec3 u = a * ia, v = b * ib, d = u - v;
  float spread = 0.5 * dot(d, d);
  float nu = dot(normal, u), nv = dot(normal, v);
  vec2 hull = nook_hull_factor(su, sv, spread);
  phi = hull.x * u + hull.y * v;
  float sum = hull.x + hull.y;
  float size2 = max(sum * sum - 2.0 * hull.x * hull.y * spread, 0.0);
  return min(nook_above_horizon(hull.x * nu + hull.y * nv, size2, min(nu / su, nv / sv)), 1.0);
}

// Returns the same share for a distant capsule, which is treated as a narrow strip. For 99 % of capsules
// whose ends have sines below 0.25, the difference from the function above is at most 0.003. Let g be the
// vector in the plane of u and v with dot(g, u) = s_u and dot(g, v) = s_v. Then the strip's sine along the
// arc of w from u to v is dot(g, w), and its integral 2 / pi dot(g, w) w over the arc is
//   (lambda + s) (s_u + s_v) / (2 (1 + c)) (u + v) + (lambda - s) (s_u - s_v) / (2 (1 - c)) (u - v), over pi,
// where lambda is the angle between both and s its sine. In addition, each end contributes half of the vector
// of its disc. For the share above the horizon, the region is treated as a very distant disc with the same
// vector.
float nook_world_far_coverage(vec4 end_a, vec4 end_b, vec3 point, vec3 normal, out vec3 phi) {
  vec3 a = end_a.xyz - point, b = end_b.xyz - point;
  float ia = inversesqrt(dot(a, a)), ib = inversesqrt(dot(b, b));
  float su = end_a.w * ia, sv = end_b.w * ib;
  float c = clamp(dot(a, b) * (ia * ib), -0.999, 1.0);
  float nu = dot(normal, a) * ia, nv = dot(normal, b) * ib;
  float lambda = nook_angle_of_versine(1.0 - c), s = sqrt(1.0 - c * c);
  float together = (lambda + s) * (su + sv) / (1.0 + c) * 0.159154943;
  // Approximates (lambda - s) / (1 - c) / (2 pi), with an error of at most 0.002 up to a right angle.
  float apart = lambda * (0.00194 * lambda * lambda + 0.0530516) * (su - sv);
  float hu = together + apart + 0.5 * su * su, hv = together - apart + 0.5 * sv * sv;
  phi = (hu * ia) * a + (hv * ib) * b;
  float size2 = hu * hu + hv * hv + 2.0 * hu * hv * c;
  float factor = hu * nu + hv * nv;
  // 1 / size, and its square root.
  float inverse = inversesqrt(size2 + 1e-20), inverse_root = sqrt(inverse);
  float t = clamp(factor * (inverse * inverse_root), -1.0, 1.0), q = 1.0 - t * t;
  float cube = size2 * inverse_root;
  return clamp(factor + cube * (0.5 * (1.0 - t) - q * (NOOK_HORIZON_FAR_2 * q + NOOK_HORIZON_FAR_1)), 0.0, 1.0);
}
