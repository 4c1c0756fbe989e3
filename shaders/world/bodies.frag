// Draws only the pixels of one question of BodyWatch. A query then counts them.
#include "shaders/nnao/host_depth.glsl"
#include "shaders/world/body_questions.h"

uniform NOOK_HOST_IMAGE nook_layer;
uniform int nook_question;
// Each body has two spheres (centre, radius): one around it, and one inside its thickest capsule.
uniform int nook_body_count;
uniform vec4 nook_body_spheres[2 * NOOK_WATCHED_BODIES];
uniform vec4 nook_watched_light;  // the unit vector towards the light, and a distance

out vec4 nook_out;

// Without a mask, every surface may belong to a body.
bool nook_may_be_body(ivec2 pixel) {
  return nook_layer_mode < NOOK_LAYER_REPLACE || nook_host_texel(nook_layer, pixel).g > 0.5;
}

bool nook_is_in_body(vec3 position) {
  for (int i = 0; i < nook_body_count; ++i)
    if (distance(position, nook_body_spheres[2 * i].xyz) <= nook_body_spheres[2 * i].w) return true;
  return false;
}

// Returns the direction in which the camera looks at a surface.
vec3 nook_look_direction(vec3 position) {
  return nook_spread.y != 0.0 ? vec3(0.0, 0.0, -1.0) : normalize(position);
}

// True if the ray to the surface passes through the middle of a body, and the surface is behind the body.
bool nook_shows_through_body(vec3 position) {
  vec3 eye = nook_spread.y != 0.0 ? vec3(position.xy, 0.0) : vec3(0.0);
  vec3 direction = nook_look_direction(position);
  for (int i = 0; i < nook_body_count; ++i) {
    vec4 body = nook_body_spheres[2 * i], middle = nook_body_spheres[2 * i + 1];
    vec3 to_middle = middle.xyz - eye;
    float along = dot(to_middle, direction);
    bool hits = along > 0.0 && length(to_middle - along * direction) < middle.w;
    if (hits && distance(eye, body.xyz) > 1.5 * body.w && dot(position - body.xyz, direction) > body.w) return true;
  }
  return false;
}

bool nook_is_counted(ivec2 pixel, vec3 position, vec3 normal) {
  if (nook_question == NOOK_BODIES_SHOW_THROUGH) return nook_shows_through_body(position);
  if (nook_question == NOOK_BODIES_FAR_ENOUGH) return length(position) > nook_watched_light.w;
  if (nook_question == NOOK_BODIES_LIT) return dot(normal, nook_watched_light.xyz) > 0.0;
  if (nook_question == NOOK_BODIES_SURFACE) return true;
  if (!nook_may_be_body(pixel)) return false;
  return nook_question == NOOK_BODIES_MASKED || nook_is_in_body(position);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - nook_origin;
  float depth = nook_screen_depth(pixel);
  // The sky does not count: a body beyond the far plane does not hide it.
  bool there = depth != nook_no_surface;
  vec3 position = nook_position(nook_screen_rays, vec2(pixel), there ? depth : 1.0);
  // At the edge of a surface, the normal is wrong, but these pixels are few.
  vec3 normal = normalize(cross(dFdx(position), dFdy(position)));
  // A projection may mirror the picture.
  if (dot(normal, nook_look_direction(position)) > 0.0) normal = -normal;
  if (!there) discard;
  if (!nook_is_counted(pixel, position, normal)) discard;
  nook_out = vec4(0.0);
}
