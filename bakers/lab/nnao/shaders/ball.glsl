// Makes points in the unit ball. They are spread evenly over directions. Their distances from the centre are
// also spread evenly, so the points are denser near the centre. Each pixel of a neighbourhood mirrors the
// points at a different plane.
vec3 on_sphere(float share, float turn) {
  float z = 1.0 - 2.0 * share;
  float angle = 6.2831853 * turn;
  return vec3(sqrt(max(1.0 - z * z, 0.0)) * vec2(cos(angle), sin(angle)), z);
}

vec3 ball_point(int i, int count, vec2 noise) {
  vec3 direction = on_sphere((float(i) + 0.5) / float(count), fract(float(i) * 0.61803399));
  float size = (fract(float(i) * 0.75487767) * float(count - 1) + noise.y) / float(count);
  return reflect(direction, on_sphere(noise.x, noise.y)) * max(size, 0.05);
}
