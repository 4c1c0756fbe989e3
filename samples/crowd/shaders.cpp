#include "samples/crowd/shaders.h"

namespace crowd {

const char* const kCharacterVertex = R"(#version 330 core
layout(location = 0) in vec3 position_m;
layout(location = 1) in vec3 normal;
layout(location = 2) in uvec4 joints;
layout(location = 3) in vec4 weights;
layout(location = 4) in float ao;
layout(location = 5) in vec3 light_value;
uniform samplerBuffer bones;
uniform int first_bone_texel;
uniform mat4 clip_from_world;
uniform vec3 instance_albedo;
out vec3 surface_position_ws;
out vec3 surface_normal_ws;
out vec3 surface_albedo;
out float surface_ao;
out vec3 surface_light;
vec4 bone_row(int bone, int row) { return texelFetch(bones, first_bone_texel + 3 * bone + row); }
void main() {
  vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
  for (int i = 0; i < 4; ++i)
    for (int r = 0; r < 3; ++r) rows[r] += weights[i] * bone_row(int(joints[i]), r);
  vec4 p = vec4(position_m, 1.0);
  surface_position_ws = vec3(dot(rows[0], p), dot(rows[1], p), dot(rows[2], p));
  surface_normal_ws = vec3(dot(rows[0].xyz, normal), dot(rows[1].xyz, normal), dot(rows[2].xyz, normal));
  surface_albedo = instance_albedo;
  surface_ao = ao;
  surface_light = light_value;
  gl_Position = clip_from_world * vec4(surface_position_ws, 1.0);
}
)";

const char* const kGroundVertex = R"(#version 330 core
uniform mat4 clip_from_world;
uniform vec3 instance_albedo;
uniform float ground_half_size_m;
out vec3 surface_position_ws;
out vec3 surface_normal_ws;
out vec3 surface_albedo;
out float surface_ao;
out vec3 surface_light;
void main() {
  vec2 corner = vec2(float(gl_VertexID & 1), float(gl_VertexID >> 1)) * 2.0 - 1.0;
  surface_position_ws = vec3(corner.x, 0.0, corner.y) * ground_half_size_m;
  surface_normal_ws = vec3(0.0, 1.0, 0.0);
  surface_albedo = instance_albedo;
  surface_ao = 1.0;
  surface_light = vec3(1.0);
  gl_Position = clip_from_world * vec4(surface_position_ws, 1.0);
}
)";

const char* const kSurfaceFragment = R"(#version 330 core
in vec3 surface_normal_ws;
uniform float layer_weight;
layout(location = 0) out vec4 normal_ws;
layout(location = 1) out vec2 layer;
void main() {
  normal_ws = vec4(0.5 * normalize(surface_normal_ws) + 0.5, 1.0);
  layer = vec2(1.0, layer_weight);
}
)";

const char* const kVersion = "#version 330 core\n";

const char* const kScreenAo = R"(
uniform bool use_screen_ao;
uniform sampler2D screen_ao;
uniform sampler2D screen_depth;
// The picture is multisampled and AO is not, so that at an edge the texel may belong to another surface. This takes
// the texel, of this one and the four beside it, whose depth is nearest.
vec4 fetch_screen_light() {
  const ivec2 steps[5] = ivec2[5](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
  ivec2 pixel = ivec2(gl_FragCoord.xy), last = textureSize(screen_depth, 0) - 1, best = pixel;
  float min_off = 2.0;
  for (int i = 0; i < 5; ++i) {
    ivec2 candidate = clamp(pixel + steps[i], ivec2(0), last);
    float off = abs(texelFetch(screen_depth, candidate, 0).r - gl_FragCoord.z);
    if (off < min_off) best = candidate;
    min_off = min(min_off, off);
  }
  return texelFetch(screen_ao, best, 0);
}
float fetch_screen_ao() { return fetch_screen_light().r; }
)";

const char* const kLitFragment = R"(
in vec3 surface_position_ws;
in vec3 surface_normal_ws;
in vec3 surface_albedo;
in float surface_ao;
uniform sampler2DShadow shadow_map;
uniform mat4 shadow_from_world;
uniform vec3 to_key_ws;
uniform float key_strength;
uniform float ao_strength;
uniform bool use_floor_ao;
uniform sampler2D floor_ao;
uniform vec2 floor_first_m;
uniform vec2 floor_extent_m;
uniform vec3 eye_ws;
uniform vec3 background;
uniform float fog_start_m;
out vec4 colour;
float key_visibility(vec3 n) {
  // The point moves along its normal by about a texel of the map, so that it does not shadow itself.
  vec4 s = shadow_from_world * vec4(surface_position_ws + 0.025 * n, 1.0);
  vec3 uvz = s.xyz * 0.5 + 0.5;
  if (any(lessThan(uvz, vec3(0.0))) || any(greaterThan(uvz, vec3(1.0)))) return 1.0;
  vec2 texel = 1.5 / vec2(textureSize(shadow_map, 0));
  float sum = 0.0;
  for (int y = -1; y <= 1; ++y)
    for (int x = -1; x <= 1; ++x) sum += texture(shadow_map, vec3(uvz.xy + vec2(x, y) * texel, uvz.z - 0.0008));
  return sum / 9.0;
}
void main() {
  vec3 n = normalize(surface_normal_ws);
  vec3 sky = vec3(0.80, 0.87, 1.00), bounce = vec3(0.46, 0.43, 0.40);
  vec3 ambient = mix(bounce, sky, 0.5 + 0.5 * n.y) * 0.58;
  float ao = surface_ao;
  if (use_screen_ao) ao *= fetch_screen_ao();
  if (use_floor_ao) ao *= texture(floor_ao, (surface_position_ws.xz - floor_first_m) / floor_extent_m).r;
  ao = mix(1.0, ao, ao_strength);
  float key = max(dot(n, to_key_ws), 0.0);
  if (key > 0.0 && key_strength > 0.0) key *= key_visibility(n);
  vec3 light = ambient * ao + key * key_strength * vec3(1.0, 0.95, 0.86);
  float distance_m = length(surface_position_ws - eye_ws);
  float fog = 1.0 - exp(-max(distance_m - fog_start_m, 0.0) / (0.7 * fog_start_m));
  colour = vec4(mix(surface_albedo * light, background, fog), 1.0);
}
)";

const char* const kGivenLightFragment = R"(#version 330 core
in vec3 surface_position_ws;
in vec3 surface_albedo;
in vec3 surface_light;
uniform bool use_floor_light;
uniform sampler2D floor_light;
uniform vec2 floor_first_m;
uniform vec2 floor_extent_m;
uniform float exposure;
uniform vec3 background;
out vec4 colour;
void main() {
  vec3 irradiance = surface_light;
  float edge = 0.0;
  if (use_floor_light) {
    vec2 uv = (surface_position_ws.xz - floor_first_m) / floor_extent_m;
    irradiance = texture(floor_light, uv).rgb;
    // The picture fades out where the floor's light is unknown.
    edge = smoothstep(0.85, 1.0, 2.0 * length(uv - 0.5));
  }
  vec3 seen = 1.0 - exp(-exposure * surface_albedo * irradiance * 0.31830989);
  colour = vec4(mix(seen, background, edge), 1.0);
}
)";

const char* const kProbeLightFragment = R"(
in vec3 surface_position_ws;
in vec3 surface_normal_ws;
in vec3 surface_albedo;
in vec3 surface_light;
uniform int light;
#ifdef GROUND
uniform vec3 ground_irradiance;
uniform vec3 ground_sun_irradiance;
#endif
uniform float ao_strength;
uniform float exposure;
uniform float fog_start_m;
uniform vec3 eye_ws;
uniform vec3 background;
out vec4 colour;
void main() {
#ifdef GROUND
  // The open shares of soft light, and in alpha that of the sun, behind characters and the screen.
  vec4 open = mix(vec4(1.0), use_screen_ao ? fetch_screen_light() : vec4(1.0), ao_strength);
  vec3 irradiance = ground_irradiance * open.rgb + ground_sun_irradiance * open.a;
#else
  vec3 occlusion = mix(vec3(1.0), surface_light, ao_strength);
  vec3 irradiance = nook_scene_irradiance(light, normalize(surface_normal_ws), occlusion);
#endif
  vec3 seen = 1.0 - exp(-exposure * surface_albedo * irradiance * 0.31830989);
  float distance_m = length(surface_position_ws - eye_ws);
  float fog = 1.0 - exp(-max(distance_m - fog_start_m, 0.0) / (0.7 * fog_start_m));
  colour = vec4(mix(seen, background, fog), 1.0);
}
)";

const char* const kShadowFragment = R"(#version 330 core
void main() {}
)";

}  // namespace crowd
