// The page's own shaders. Nook computes light and occlusion: the text of its functions is inserted before the shaders that call
// them.

// Skins each vertex once per frame. Transform feedback keeps position and normal for the passes that follow.
export const skinVertex = `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;
uniform highp sampler2D bones;
uniform int body;
out vec3 world;
out vec3 world_normal;
void main() {
  vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 3; ++r) rows[r] += weights[i] * texelFetch(bones, ivec2(3 * int(joints[i]) + r, body), 0);
  vec4 p = vec4(position, 1.0);
  world = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
  world_normal = vec3(dot(rows[0].xyz, normal), dot(rows[1].xyz, normal), dot(rows[2].xyz, normal));
}`;

export const bodyVertex = `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 4) in float ao;
layout(location = 5) in vec3 directional_ao;
layout(location = 6) in float reference;
uniform mat4 clip_from_world;
out vec3 world;
out vec3 world_normal;
out float surface_ao;
out vec3 surface_directional_ao;
out float surface_error;
void main() {
  world = position;
  world_normal = normal;
  surface_ao = ao;
  surface_directional_ao = directional_ao;
  surface_error = ao - reference;
  gl_Position = clip_from_world * vec4(world, 1.0);
}`;

export const bodyDepthVertex = `
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
void main() { gl_Position = clip_from_world * vec4(position, 1.0); }`;

export const depthFragment = "void main() {}";

export const groundVertex = `
uniform mat4 clip_from_world;
uniform float half_size;
out vec3 world;
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  world = vec3(corner.x, 0.0, corner.y) * half_size;
  gl_Position = clip_from_world * vec4(world, 1.0);
}`;

// A ball with the tangents of its texture coordinates.
export const ballVertex = `
layout(location = 0) in vec3 direction;
layout(location = 1) in vec2 texture_coordinate;
uniform mat4 clip_from_world;
uniform vec4 ball;
out vec3 world;
out vec3 world_normal;
out vec3 world_tangent;
out vec2 uv;
void main() {
  world = ball.xyz + ball.w * direction;
  world_normal = direction;
  world_tangent = normalize(vec3(direction.z, 0.0, -direction.x) + vec3(1e-5, 0.0, 0.0));
  uv = texture_coordinate;
  gl_Position = clip_from_world * vec4(world, 1.0);
}`;

// Code that all lit surfaces share. The canvas is multisampled and the screen-space AO is not, so at an edge, its texel may
// belong to another surface. From this texel and the four texels beside it, the function takes the one with the nearest depth.
const surface = `
uniform vec3 eye;
uniform vec3 background;
uniform float exposure;
uniform vec3 lamp_direction;
uniform vec3 lamp_colour;
uniform highp sampler2DShadow lamp_depth;
uniform mat4 lamp_from_world;
uniform bool use_screen_ao;
uniform highp sampler2D screen_ao;
uniform highp sampler2D screen_depth;
out vec4 colour;
float screen_occlusion() {
  if (!use_screen_ao) return 1.0;
  ivec2 steps[5] = ivec2[5](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(screen_depth, 0) - 1, best = pixel;
  float nearest = 2.0;
  for (int i = 0; i < 5; ++i) {
    ivec2 candidate = clamp(pixel + steps[i], ivec2(0), last);
    float off = abs(texelFetch(screen_depth, candidate, 0).r - gl_FragCoord.z);
    if (off < nearest) best = candidate;
    nearest = min(nearest, off);
  }
  return texelFetch(screen_ao, best, 0).r;
}
float lamp_visibility(vec3 p, vec3 n) {
  vec3 s = (lamp_from_world * vec4(p + 0.02 * n, 1.0)).xyz * 0.5 + 0.5;
  if (any(lessThan(s, vec3(0.0))) || any(greaterThan(s, vec3(1.0)))) return 1.0;
  vec2 texel = 1.6 / vec2(textureSize(lamp_depth, 0));
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) sum += texture(lamp_depth, vec3(s.xy + vec2(x, y) * texel, s.z - 0.0012));
  return sum / 9.0;
}
vec3 lamp(vec3 p, vec3 n) {
  float cosine = dot(n, lamp_direction);
  return cosine > 0.0 ? lamp_colour * cosine * lamp_visibility(p, n) : vec3(0.0);
}
vec3 shown(vec3 radiance, vec3 p) {
  vec3 mapped = pow(1.0 - exp(-exposure * radiance), vec3(1.0 / 2.2));
  float fog = smoothstep(9.0, 22.0, length(p.xz));
  return mix(mapped, background, fog);
}`;

// form: "constant", "probe" or "lobes".
export const bodyFragment = (glsl, form) => `${glsl}${surface}
#define FORM_${form.toUpperCase()}
in vec3 world;
in vec3 world_normal;
in float surface_ao;
in vec3 surface_directional_ao;
in float surface_error;
uniform vec3 albedo;
uniform bool use_ao;
uniform int view;       // 0 lit, 1 AO, 2 error
uniform int light;
uniform vec3 constant_irradiance;
vec3 error_colour(float e) {
  float t = clamp(abs(e) / 0.25, 0.0, 1.0);
  return mix(vec3(0.93), e < 0.0 ? vec3(0.10, 0.28, 0.75) : vec3(0.78, 0.10, 0.08), pow(t, 0.8));
}
void main() {
  vec3 n = normalize(world_normal);
  float ao = use_ao ? surface_ao : screen_occlusion();
  if (view == 1) { colour = vec4(vec3(pow(ao, 1.0 / 1.4)), 1.0); return; }
  if (view == 2) {
    float shade = 0.72 + 0.28 * clamp(dot(n, normalize(eye - world)), 0.0, 1.0);
    colour = vec4(error_colour(surface_error) * shade, 1.0);
    return;
  }
#if defined(FORM_LOBES)
  vec3 e = nook_scene_irradiance(light, n, use_ao ? surface_directional_ao : vec3(ao));
#elif defined(FORM_PROBE)
  vec3 e = nook_probe_irradiance(nook_probe_place(world), n) * ao;
#else
  vec3 e = constant_irradiance * ao;
#endif
  colour = vec4(shown(albedo / 3.14159265 * (e + lamp(world, n)), world), 1.0);
}`;

export const groundFragment = `${surface}
in vec3 world;
uniform int view;
uniform vec3 ground_irradiance;
void main() {
  vec3 n = vec3(0.0, 1.0, 0.0);
  float ao = screen_occlusion();
  if (view == 1) { colour = vec4(mix(vec3(pow(ao, 1.0 / 1.4)), vec3(1.0), smoothstep(9.0, 22.0, length(world.xz))), 1.0); return; }
  if (view == 2) { colour = vec4(mix(vec3(0.86), vec3(0.95), smoothstep(2.0, 12.0, length(world.xz))), 1.0); return; }
  vec3 e = ground_irradiance * ao;
  vec2 cell = abs(fract(world.xz) - 0.5), width = fwidth(world.xz) * 0.8;
  vec2 line = smoothstep(0.5 - 0.006 - width, vec2(0.5), cell) * clamp(0.02 / max(width.x, width.y), 0.0, 1.0);
  vec3 albedo = vec3(0.46, 0.45, 0.43) * (1.0 - 0.22 * max(line.x, line.y));
  colour = vec4(shown(albedo / 3.14159265 * (e + lamp(world, n)), world), 1.0);
}`;

export const ballFragment = (glsl) => `${glsl}${surface}
in vec3 world;
in vec3 world_normal;
in vec3 world_tangent;
in vec2 uv;
uniform int view;
uniform bool solid;
void main() {
  vec3 n = normalize(world_normal), t = normalize(world_tangent), b = cross(n, t);
  mat3 to_tangent = transpose(mat3(t, b, n));
  vec3 sight = to_tangent * normalize(eye - world);
  vec2 dx = dFdx(uv), dy = dFdy(uv);
  float alpha = nook_material_visibility(nook_material_occlusion(uv, dx, dy, sight));
  if (solid ? alpha < 1.0 : alpha >= 1.0 || alpha <= 0.0) discard;
  if (view > 0) { colour = vec4(vec3(0.93 * (view == 1 ? screen_occlusion() : 0.9)), alpha); return; }
  vec4 modes[NOOK_LIGHT_VEC4_COUNT];
  nook_material_decode(uv, dx, dy, sight, modes);
  // Adds the lamp, and the probe's light as a single light nearly along the normal.
  vec3 radiance = vec3(0.0);
  if (dot(n, lamp_direction) > 0.0)
    radiance += nook_material_radiance(modes, to_tangent * lamp_direction) * lamp_colour * lamp_visibility(world, n);
  vec3 e = nook_probe_irradiance(nook_probe_place(world), n) * screen_occlusion();
  radiance += nook_material_radiance(modes, normalize(vec3(0.35, 0.2, 1.0))) * e;
  colour = vec4(shown(radiance, world), alpha);
}`;

// Shows the texture of the pass, for the view of screen-space AO alone.
export const screenVertex = `
void main() { gl_Position = vec4(vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 4.0 - 1.0, 0.0, 1.0); }`;
export const screenFragment = `
uniform highp sampler2D screen_ao;
out vec4 colour;
void main() { colour = vec4(vec3(pow(texelFetch(screen_ao, ivec2(gl_FragCoord.xy), 0).r, 1.0 / 1.4)), 1.0); }`;
