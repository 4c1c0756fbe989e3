// Computes the open share of the light in each colour channel, and the open share of one cone of light, at a
// point. Formulas and names are as in sdk/src/world/light_terms.h and cone.h.
#include "shaders/core/texels.glsl"
#include "shaders/world/constants.h"

// The light's terms in view space (sdk/src/world/light_terms.h), followed by LightTerms::darkest.
uniform vec4 nook_world_light_terms[NOOK_LIGHT_VEC4S];

// Sums over the casters of a point: the terms of their densities, in the order of the light's terms. Each
// caster is weighted by its share.
struct NookTaken {
  float scalar;
  vec4 terms[6];
};
#define NOOK_NOTHING_TAKEN NookTaken(0.0, vec4[6](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0)))
NookTaken nook_world_taken = NOOK_NOTHING_TAKEN;

// `band` holds the bands 1 to 4 of the density, multiplied by `weight`.
void nook_world_add(inout NookTaken taken, vec3 d, float weight, vec4 band) {
  vec3 squared = d * d, mixed = d * d.yzx;  // mixed: xy, yz, zx
  float apart = squared.x - squared.y, along_x = squared.x - 3.0 * squared.y, along_y = 3.0 * squared.x - squared.y;
  float five = 5.0 * squared.z - 1.0, seven = 7.0 * squared.z - 1.0;
  taken.scalar += weight;
  taken.terms[0] += vec4(band.x * d, band.y * (3.0 * squared.z - 1.0));
  taken.terms[1] += band.y * vec4(mixed, apart);
  taken.terms[2] += band.z * vec4(d.y * along_y, mixed.x * d.z, d.y * five, d.z * (five - 2.0));
  taken.terms[3] += vec4(band.z * vec3(d.x * five, d.z * apart, d.x * along_x),
                         band.w * (squared.z * (35.0 * squared.z - 30.0) + 3.0));
  taken.terms[4] += band.w * vec4(mixed.x * apart, mixed.y * along_y, mixed.x * seven, mixed.y * (seven - 2.0));
  taken.terms[5] += band.w * vec4(mixed.z * (seven - 2.0), apart * seven, mixed.z * along_x,
                                  squared.x * along_x - squared.y * along_y);
}

void nook_world_gather(vec3 phi, vec3 normal, float share) {
  float size2 = dot(phi, phi), inverse_size = inversesqrt(max(size2, 1e-20));
  float size = min(size2 * inverse_size, 1.0), sine = sqrt(size);
  float cosine = dot(phi, normal) * inverse_size;
  float lift = max(0.5 * (max(cosine, -sine) + sine) - cosine, 0.0);
  vec3 d = phi * inverse_size + normal * lift;
  d *= inversesqrt(max(dot(d, d), 1e-12));
  float left = 1.0 - size;
  nook_world_add(nook_world_taken, d, share,
                 share * vec4(1.0 - size * (size * NOOK_DISC_BAND_12 + NOOK_DISC_BAND_11), 1.0 - size * NOOK_DISC_BAND_21,
                              left * sqrt(left), 1.0 - size * (NOOK_DISC_BAND_41 - size * NOOK_DISC_BAND_42)));
}

vec3 nook_world_light_under(NookTaken taken) {
  vec3 sum = taken.scalar * nook_world_light_terms[0].rgb;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 4; ++j) sum += taken.terms[i][j] * nook_world_light_terms[1 + 4 * i + j].rgb;
  return sum;
}

// `ao` is the AO of the gathered casters.
vec3 nook_world_open_light(vec3 normal, float ao) {
  NookTaken hemisphere = NOOK_NOTHING_TAKEN;
  nook_world_add(hemisphere, normal, 1.0, vec4(2.0 / 3.0, 0.25, 0.0, -1.0 / 24.0));
  vec3 ratio = nook_world_light_under(nook_world_taken) /
               max(nook_world_light_under(hemisphere), nook_world_light_terms[NOOK_LIGHT_TERMS].rgb);
  return clamp(1.0 - (1.0 - ao) / max(nook_world_taken.scalar, 1e-12) * ratio, 0.0, 1.0);
}

// The array begins with the axes of the cone's parts, each with its slope. Then comes the axis of the cone,
// with its reach in metres. The last vector contains the cosine and sine of the half angle of a wider cone,
// which contains all parts completely.
uniform vec4 nook_world_cone[NOOK_CONE_VEC4S];
float nook_world_parts[NOOK_CONE_PARTS];

// Returns true if a sphere may be inside the cone. `centre` is relative to the point.
bool nook_world_in_cone(vec3 centre, float radius) {
  vec4 axis = nook_world_cone[NOOK_CONE_PARTS], round = nook_world_cone[NOOK_CONE_PARTS + 1];
  float depth = dot(centre, axis.xyz), aside = sqrt(max(dot(centre, centre) - depth * depth, 0.0));
  return depth > -radius && depth < axis.w + radius && aside * round.x - depth * round.y < radius;
}

float nook_share_beyond(float s) {
  float x = clamp(s, -1.0, 1.0);
  return x * (x * x * NOOK_SEGMENT_3 + NOOK_SEGMENT_1) + 0.5;
}

float nook_share_between(float from, float to) {
  float x = clamp(from, -1.0, 1.0), y = clamp(to, -1.0, 1.0);
  return x * (x * x * NOOK_SEGMENT_3 + NOOK_SEGMENT_1) - y * (y * y * NOOK_SEGMENT_3 + NOOK_SEGMENT_1);
}

// Returns the share of a part that a capsule hides. a.xyz is the first end of the capsule, relative to the
// point, and a.w its radius. `e` is the difference of the second and the first end, with the radius in w.
// part.xyz is the unit axis of the part, and part.w its slope.
float nook_part_coverage(vec4 a, vec4 e, vec4 part) {
  float depth_a = dot(a.xyz, part.xyz), range = dot(e.xyz, part.xyz), depth_b = depth_a + range;
  float deepest = max(depth_a, depth_b), smallest = 0.02 * deepest;
  float da = max(depth_a, smallest), db = max(depth_b, smallest);
  float inverse_range = 1.0 / (range + 1e-20), scale = 1.0 / (da * db * part.w);
  vec4 pa = ((da - depth_a) * inverse_range * e + a - vec4(da * part.xyz, 0.0)) * (db * scale);
  vec4 pb = ((db - depth_b) * inverse_range + 1.0) * e + a;
  pb = (pb - vec4(db * part.xyz, 0.0)) * (da * scale);
  vec4 d = pb - pa;
  float length2 = d.x * d.x + (d.y * d.y + (d.z * d.z + 1e-12)), inverse = inversesqrt(length2), size = length2 * inverse;
  float xa = dot(pa.xyz, d.xyz) * inverse, aside2 = abs(dot(pa.xyz, pa.xyz) - xa * xa), aside = sqrt(aside2);
  float nearest = clamp((d.w * inverse * aside - xa) * inverse, 0.0, 1.0);
  float radius = nearest * d.w + pa.w, along_x = nearest * size + xa;
  float edge = nook_share_beyond(sqrt(along_x * along_x + aside2) - radius);
  float cap = 0.785398163 * radius;
  float across = nook_share_between(aside - radius, aside + radius);
  float along = nook_share_between(xa - cap, xa + size + cap);
  float share = mix(across * along, edge, clamp(radius - NOOK_NARROW_RADIUS, 0.0, 1.0));
  return deepest > 1e-6 ? share : 0.0;
}

// Multiplies the openness of the cone's parts by the shadow of one body. The body has two texels in the
// table. The first contains the centre and radius of the sphere around the body. The second contains the
// index of the texel of its first caster, and the number of casters.
void nook_world_body_shade(NOOK_TEXELS table, int texel, vec3 point) {
  vec4 bound = nook_texel(table, texel);
  if (!nook_world_in_cone(bound.xyz - point, bound.w)) return;
  vec4 range = nook_texel(table, texel + 1);
  int from = int(range.x), to = from + NOOK_CASTER_TEXELS * int(range.y);
  for (int k = from; k < to; k += NOOK_CASTER_TEXELS) {
    vec4 a = nook_texel(table, k), b = nook_texel(table, k + 1);
    a.xyz -= point;
    b.xyz -= point;
    if (nook_world_in_cone(0.5 * (a.xyz + b.xyz), 0.5 * distance(a.xyz, b.xyz) + max(a.w, b.w)))
      for (int i = 0; i < NOOK_CONE_PARTS; ++i) nook_world_parts[i] *= 1.0 - nook_part_coverage(a, b - a, nook_world_cone[i]);
  }
}

float nook_world_open_cone() {
  float sum = 0.0;
  for (int i = 0; i < NOOK_CONE_PARTS; ++i) sum += nook_world_parts[i];
  return sum / float(NOOK_CONE_PARTS);
}
