// A slice is a plane that contains the direction to the viewer and cuts the hemisphere. Horizon and bitmask
// methods both use slices. Angles in a slice are measured from the direction to the viewer, in radians. They
// grow along the slice's direction on the screen.
struct Slice {
  vec2 direction;   // on the screen
  float tilt;       // angle of the normal, projected into the slice
  float projected;  // length of that projection
};

Slice make_slice(int i, vec2 noise, vec3 normal, vec3 viewer) {
  float angle = pi * (float(i) + noise.x) / float(groups);
  Slice slice;
  slice.direction = vec2(cos(angle), sin(angle));
  vec3 along = vec3(slice.direction, 0.0);
  vec3 across = normalize(along - dot(along, viewer) * viewer);
  float u = dot(normal, across), v = dot(normal, viewer);
  slice.projected = length(vec2(u, v));
  slice.tilt = atan(u, v);
  return slice;
}

float step_px(int k, vec2 noise, float radius_px) {
  float share = (float(k) + noise.y) / float(steps);
  return max(float(k) + 1.0, radius_px * share * share);
}

// Returns the integral of cos(t - tilt) |sin t| over t, from the direction to the viewer (t = 0) to `angle`
// (Jimenez et al., equation 7).
float arc(float angle, float tilt) {
  return 0.25 * (cos(tilt) + 2.0 * angle * sin(tilt) - cos(2.0 * angle - tilt));
}

// Returns the integral over the whole slice.
float open_arc(float tilt) {
  return arc(tilt - 0.5 * pi, tilt) + arc(tilt + 0.5 * pi, tilt);
}
