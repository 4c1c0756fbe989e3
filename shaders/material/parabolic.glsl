// Maps the hemisphere to the unit disc. Directions below the horizon are moved to the horizon.
// sdk/src/material/parabolic.h has the same functions.
vec2 nook_parabolic(vec3 d) {
  return d.xy / (d.z > 0.0 ? 1.0 + d.z : max(length(d.xy), 1e-6));
}

// Returns the position of a direction in a side x side map, in units of cells.
vec2 nook_parabolic_place(vec3 d, int side) {
  return clamp(0.5 * nook_parabolic(d) + 0.5, 0.0, 1.0) * float(side);
}
