// Encodes unit vectors as two values in [0, 1]. The sphere is projected onto an octahedron, which is unfolded
// into a square.
vec2 nook_signs(vec2 v) {
  return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 nook_octahedral(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  vec2 square = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * nook_signs(n.xy);
  return 0.5 * square + 0.5;
}

vec3 nook_from_octahedral(vec2 encoded) {
  vec2 square = 2.0 * encoded - 1.0;
  float z = 1.0 - abs(square.x) - abs(square.y);
  vec2 side = z >= 0.0 ? square : (1.0 - abs(square.yx)) * nook_signs(square);
  return normalize(vec3(side, z));
}
