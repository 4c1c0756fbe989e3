// Texels of a cube map as samples of light: direction, solid angle, radiance.
#include "shaders/probe/constants.h"

uniform highp samplerCube nook_cube;
uniform int nook_face_size;  // texels
uniform float nook_level;

struct NookCubeTexel {
  vec3 direction;     // unit
  float solid_angle;  // steradians; 0 where the radiance is not finite
  vec3 radiance;
};

// A place on a face of the cube from -1 to 1. Faces are +x, -x, +y, -y, +z, -z; their orientation does not
// count, because all texels of a face are visited and each is looked up by its direction.
vec3 nook_cube_place(int face, vec2 at) {
  float side = (face & 1) == 0 ? 1.0 : -1.0;
  if (face < 2) return vec3(side, at);
  return face < 4 ? vec3(at.x, side, at.y) : vec3(at, side);
}

// Half of the solid angle of a triangle, by A. van Oosterom and J. Strackee, The solid angle of a plane
// triangle (1983), whose tangent is det / sum. Nothing cancels, and where texels are a quarter of a face or less, the
// tangent is below 0.1 and three terms of its arcus are exact in floats.
float nook_half_angle(float det, float sum) {
  float t = det / sum, t2 = t * t;
  return t * (1.0 - t2 * (1.0 / 3.0 - t2 * 0.2));
}

// Of a texel with the centre `at` and the side 2 half_side: two triangles, which share a diagonal.
float nook_texel_angle(vec2 at, float half_side) {
  vec3 a = vec3(at + vec2(-half_side, -half_side), 1.0), b = vec3(at + vec2(half_side, -half_side), 1.0);
  vec3 c = vec3(at + vec2(half_side, half_side), 1.0), d = vec3(at + vec2(-half_side, half_side), 1.0);
  float la = length(a), lb = length(b), lc = length(c), ld = length(d), ac = dot(a, c);
  float det = 4.0 * half_side * half_side;
  return 2.0 * (nook_half_angle(det, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + ac * lb) +
                nook_half_angle(det, la * lc * ld + ac * ld + dot(c, d) * la + dot(a, d) * lc));
}

// Radiance above 1e18 counts as infinite, as in fits. Bits of magnitudes have the order of the numbers, and NaN lies above
// all of them; compilers may turn a comparison of floats round, which NaN survives.
NookCubeTexel nook_cube_texel(int face, int column, int row) {
  float half_side = 1.0 / float(nook_face_size);
  vec2 at = vec2(2 * column + 1, 2 * row + 1) * half_side - 1.0;
  NookCubeTexel texel;
  vec3 place = nook_cube_place(face, at);
  texel.direction = normalize(place);
  texel.radiance = textureLod(nook_cube, place, nook_level).rgb;
  bool finite = all(lessThanEqual(floatBitsToUint(texel.radiance) & 0x7fffffffu, uvec3(0x5d5e0b6bu)));
  texel.solid_angle = finite ? nook_texel_angle(at, half_side) : 0.0;
  if (!finite) texel.radiance = vec3(0.0);
  return texel;
}

float nook_cube_luminance(vec3 rgb) {
  return dot(rgb, vec3(NOOK_LUMINANCE_RED, NOOK_LUMINANCE_GREEN, NOOK_LUMINANCE_BLUE));
}

// The sky's share of a texel: its colour at a luminance of the limit or less.
vec3 nook_cube_without_sun(vec3 rgb, float limit) {
  float bright = nook_cube_luminance(rgb);
  return bright > limit ? rgb * (limit / bright) : rgb;
}
