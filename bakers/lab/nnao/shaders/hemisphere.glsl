// Points in the hemisphere around the normal, spread as in J. Chapman's tutorial of SSAO (2013). Their
// distances grow with the square of their index. Neighbouring pixels rotate the points by different angles.
#include "bakers/lab/nnao/shaders/ball.glsl"

vec3 hemisphere_point(int i, int count, vec2 noise, vec3 normal) {
  vec3 direction = reflect(on_sphere((float(i) + 0.5) / float(count), fract(float(i) * 0.61803399)), on_sphere(noise.x, noise.y));
  float share = float(i) / float(count);
  float size = mix(0.1, 1.0, share * share) * fract(float(i) * 0.75487767 + 0.5);
  return size * (dot(direction, normal) < 0.0 ? -direction : direction);
}
