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

// Returns the point of the cube for a position on a face. Positions are from -1 to 1, and faces are +x, -x,
// +y, -y, +z, -z. OpenGL's orientation of the faces does not matter, because all texels of a face are
// visited, and the texture is read by direction.
vec3 nook_cube_place(int face, vec2 at) {
  float side = (face & 1) == 0 ? 1.0 : -1.0;
  if (face < 2) return vec3(side, at);
  return face < 4 ? vec3(at.x, side, at.y) : vec3(at, side);
}

// Returns half of the solid angle of a triangle, after A. van Oosterom and J. Strackee, The solid angle of a
// plane triangle (1983). The tangent of this half is det / sum, whose computation has no cancellation. If a
// texel's side is at most a quarter of a face, the tangent is below 0.1, and three terms of the arctangent's
// series are exact in floats.
float nook_half_angle(float det, float sum) {
  float t = det / sum, t2 = t * t;
  return t * (1.0 - t2 * (1.0 / 3.0 - t2 * 0.2));
}

// Returns the solid angle of a texel with the centre `at` and the side length 2 half_side. It is the sum of
// two triangles.
float nook_texel_angle(vec2 at, float half_side) {
  vec3 a = vec3(at + vec2(-half_side, -half_side), 1.0), b = vec3(at + vec2(half_side, -half_side), 1.0);
  vec3 c = vec3(at + vec2(half_side, half_side), 1.0), d = vec3(at + vec2(-half_side, half_side), 1.0);
  float la = length(a), lb = length(b), lc = length(c), ld = length(d), ac = dot(a, c);
  float det = 4.0 * half_side * half_side;
  return 2.0 * (nook_half_angle(det, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + ac * lb) +
                nook_half_angle(det, la * lc * ld + ac * ld + dot(c, d) * la + dot(a, d) * lc));
}

// Reads a texel. As in fits, radiance above 1e18 is treated as infinite. The check compares the bits of the
// floats as integers. They have the same order as the magnitudes, and NaN is above all numbers. A comparison
// of floats is not safe: the compiler may invert it, and NaN would then pass.
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

// Returns the part of a texel that belongs to the sky: the texel's colour, with its luminance reduced to at
// most `limit`.
vec3 nook_cube_without_sun(vec3 rgb, float limit) {
  float bright = nook_cube_luminance(rgb);
  return bright > limit ? rgb * (limit / bright) : rgb;
}
