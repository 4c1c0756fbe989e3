// Reads texels of a cube map as samples of light: direction, solid angle, radiance.
#include "shaders/probe/constants.h"

uniform highp samplerCube nook_cube;
uniform int nook_face_size;  // texels
uniform float nook_level;

struct NookCubeTexel {
  vec3 direction;     // unit
  float solid_angle;  // steradians; 0 where the radiance is not finite
  vec3 radiance;
};

// A place on a face of the cube, from -1 to 1. Faces are +x, -x, +y, -y, +z, -z. Their orientation does not
// matter, because all texels of a face are visited and looked up by direction.
vec3 nook_cube_place(int face, vec2 at) {
  float side = (face & 1) == 0 ? 1.0 : -1.0;
  if (face < 2) return vec3(side, at);
  return face < 4 ? vec3(at.x, side, at.y) : vec3(at, side);
}

// Returns half of the solid angle of a triangle, by A. van Oosterom and J. Strackee, The solid angle of a
// plane triangle (1983), whose tangent is det / sum. Nothing cancels. If texels are a quarter of a face or
// less, the tangent is below 0.1, and three terms of its arctangent are exact in floats.
float nook_half_angle(float det, float sum) {
  float t = det / sum, t2 = t * t;
  return t * (1.0 - t2 * (1.0 / 3.0 - t2 * 0.2));
}

// Returns the solid angle of a texel with the centre `at` and the side 2 half_side, from two triangles that
// share a diagonal.
float nook_texel_angle(vec2 at, float half_side) {
  vec3 a = vec3(at + vec2(-half_side, -half_side), 1.0), b = vec3(at + vec2(half_side, -half_side), 1.0);
  vec3 c = vec3(at + vec2(half_side, half_side), 1.0), d = vec3(at + vec2(-half_side, half_side), 1.0);
  float la = length(a), lb = length(b), lc = length(c), ld = length(d), ac = dot(a, c);
  float det = 4.0 * half_side * half_side;
  return 2.0 * (nook_half_angle(det, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + ac * lb) +
                nook_half_angle(det, la * lc * ld + ac * ld + dot(c, d) * la + dot(a, d) * lc));
}

// As in fits, radiance above 1e18 counts as infinite. This compares bits, which sort like magnitudes, with
// NaN above all of them. A compiler may invert a comparison of floats, and NaN would then pass.
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

// Returns the sky's part of a texel: its colour, at the luminance of the limit or less.
vec3 nook_cube_without_sun(vec3 rgb, float limit) {
  float bright = nook_cube_luminance(rgb);
  return bright > limit ? rgb * (limit / bright) : rgb;
}
