#include "bakers/lab/crowd/dressed_bodies.h"

#include <glm/gtc/type_ptr.hpp>

namespace crowd::lab {
namespace {

// The colours of clothes and tiles. The colour of a point of the clothes depends on the point's position in
// the rest pose. The code is for the built-in character, whose arms hang at 45 degrees in the rest pose.
const char* const colours_glsl = R"(
float above(float value, float edge) {
  float w = max(fwidth(value), 1e-5);
  return smoothstep(edge - 0.5 * w, edge + 0.5 * w, value);
}
vec3 clothes(vec3 rest_m, vec3 shirt) {
  const vec3 skin = vec3(0.56, 0.37, 0.28), hair = vec3(0.11, 0.075, 0.055), trousers = vec3(0.20, 0.25, 0.36),
             shoe = vec3(0.62, 0.60, 0.56), sole = vec3(0.78);
  vec2 from_shoulder_m = vec2(abs(rest_m.x) - 0.187, rest_m.y - 1.424);
  float along_m = dot(from_shoulder_m, vec2(0.7071, -0.7071)), outward_m = dot(from_shoulder_m, vec2(0.7071));
  float arm = step(-0.10, outward_m);
  vec3 torso = mix(trousers, shirt, above(rest_m.y, 0.985));
  torso = mix(mix(sole, shoe, above(rest_m.y, 0.020)), torso, above(rest_m.y, 0.105));
  torso = mix(torso, skin, above(rest_m.y - 0.35 * rest_m.z, 1.478));
  torso = mix(torso, hair, above(rest_m.y - 0.75 * rest_m.z, 1.690));
  float bare = max(above(along_m, 0.235), 0.0);
  return mix(torso, mix(shirt, skin, bare), arm * step(rest_m.y, 1.47));
}
vec3 tiles(vec2 place_m) {
  const float tile_m = 0.45, joint_m = 0.006;
  vec2 t = place_m / tile_m, cell = floor(t), from_joint_m = tile_m * (0.5 - abs(fract(t) - 0.5));
  vec2 w = max(fwidth(place_m), vec2(1e-5));
  // Joints narrower than a pixel become lighter instead of breaking up.
  vec2 line = (1.0 - smoothstep(vec2(0.5 * joint_m) - 0.5 * w, vec2(0.5 * joint_m) + 0.5 * w, from_joint_m)) *
              min(vec2(1.0), joint_m / w);
  float odd = mod(cell.x + cell.y, 2.0);
  float far = clamp(max(w.x, w.y) / tile_m * 2.0, 0.0, 1.0);
  vec3 tile = mix(mix(vec3(0.46, 0.44, 0.41), vec3(0.39, 0.375, 0.35), odd), vec3(0.425, 0.4075, 0.38), far);
  return tile * (1.0 - 0.35 * max(line.x, line.y));
}
)";

// This text has four variants, selected by the macros GROUND and GIVEN.
const char* const dressed_fragment = R"(
in vec3 surface_position_ws;
in vec3 surface_normal_ws;
in vec3 surface_albedo;
in vec3 surface_light;
#ifndef GROUND
in vec3 surface_rest_m;
#endif
uniform int light;
uniform vec3 ground_irradiance;
uniform vec3 ground_sun_irradiance;
uniform sampler2D floor_light;
uniform vec2 floor_first_m;
uniform vec2 floor_extent_m;
uniform vec2 floor_offset_m;
uniform float ao_strength;
uniform float exposure;
uniform vec3 eye_ws;
uniform vec3 background;
out vec4 colour;
vec3 seen_irradiance() {
#ifdef GROUND
#ifdef GIVEN
  vec2 uv = (surface_position_ws.xz - floor_first_m) / floor_extent_m, rim = abs(2.0 * uv - 1.0);
  return mix(texture(floor_light, uv).rgb, ground_irradiance + ground_sun_irradiance,
             smoothstep(0.9, 1.0, max(rim.x, rim.y)));
#else
  // RGB is the open share of the soft light, and alpha is the open share of the sun.
  vec4 open = mix(vec4(1.0), fetch_screen_light(), ao_strength);
  return ground_irradiance * open.rgb + ground_sun_irradiance * open.a;
#endif
#else
#ifdef GIVEN
  return surface_light;
#else
  return nook_scene_irradiance(light, normalize(surface_normal_ws), mix(vec3(1.0), surface_light, ao_strength));
#endif
#endif
}
void main() {
#ifdef GROUND
  vec3 albedo = tiles(surface_position_ws.xz + floor_offset_m);
#else
  vec3 albedo = clothes(surface_rest_m, surface_albedo);
#endif
  vec3 seen = 1.0 - exp(-exposure * albedo * seen_irradiance() * 0.31830989);
  float fog = 1.0 - exp(-max(length(surface_position_ws - eye_ws) - 6.0, 0.0) / 7.0);
  colour = vec4(mix(seen, background, fog), 1.0);
}
)";

}  // namespace

DressedBodies::DressedBodies(const GladGLContext& gl, Renderer& parts, const char* lights)
    : gl_(gl),
      parts_(parts),
      character_(gl, {character_vertex},
                 {glsl_version, lights, fetch_screen_glsl, colours_glsl, dressed_fragment}),
      ground_(gl, {ground_vertex},
              {glsl_version, "#define GROUND\n", fetch_screen_glsl, colours_glsl, dressed_fragment}),
      given_character_(gl, {character_vertex},
                       {glsl_version, "#define GIVEN\n", colours_glsl, dressed_fragment}),
      given_ground_(gl, {ground_vertex},
                    {glsl_version, "#define GROUND\n#define GIVEN\n", colours_glsl, dressed_fragment}) {}

void DressedBodies::set_look(const platform::Program& program, const Camera& camera,
                             const DressedLook& look) {
  program.use();
  gl_.Uniform1i(program.uniform("screen_ao"), 2);
  gl_.Uniform1i(program.uniform("screen_depth"), 3);
  gl_.Uniform1i(program.uniform("floor_light"), 4);
  gl_.Uniform1i(program.uniform("nook_scene_lights"), 5);
  gl_.Uniform3fv(program.uniform("ground_irradiance"), 1, glm::value_ptr(look.light.soft_up));
  gl_.Uniform3fv(program.uniform("ground_sun_irradiance"), 1, glm::value_ptr(look.light.sun_up));
  gl_.Uniform2fv(program.uniform("floor_offset_m"), 1, glm::value_ptr(look.floor_offset_m));
  gl_.Uniform1f(program.uniform("ao_strength"), look.ao_strength);
  gl_.Uniform1f(program.uniform("exposure"), look.light.exposure);
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
  gl_.Uniform3fv(program.uniform("background"), 1, glm::value_ptr(background_));
}

// Clears the picture and returns the matrix from world space to clip space.
glm::mat4 DressedBodies::begin(const Camera& camera, const DressedLook& look) {
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  gl_.Enable(GL_DEPTH_TEST);
  // The background has the colour of the sky at the horizon in front of the camera.
  glm::vec3 ahead = camera.target_ws - camera.eye_ws;
  ahead = glm::normalize(glm::vec3(ahead.x, 0.4f * glm::length(glm::vec2(ahead.x, ahead.z)), ahead.z));
  background_ = 1.0f - glm::exp(-look.light.exposure * look.light.radiance(ahead));
  gl_.ClearColor(background_.r, background_.g, background_.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  return clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
}

void DressedBodies::draw(std::span<const DrawnInstance> instances, const Camera& camera,
                         const DressedLook& look, GLuint lobes_texture, const ScreenAo& screen_ao) {
  const glm::mat4 clip_from_ws = begin(camera, look);
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, screen_ao.texture);
  gl_.ActiveTexture(GL_TEXTURE3);
  gl_.BindTexture(GL_TEXTURE_2D, screen_ao.depth);
  gl_.ActiveTexture(GL_TEXTURE5);
  gl_.BindTexture(GL_TEXTURE_BUFFER, lobes_texture);
  set_look(ground_, camera, look);
  parts_.draw_ground(ground_, glm::vec3(1), clip_from_ws);
  set_look(character_, camera, look);
  parts_.draw_characters(character_, instances, clip_from_ws);
}

void DressedBodies::draw_given(std::span<const DrawnInstance> instances, const Camera& camera,
                               const DressedLook& look, const FloorTexture& irradiance) {
  const glm::mat4 clip_from_ws = begin(camera, look);
  set_look(given_ground_, camera, look);
  set_floor(gl_, given_ground_, irradiance);
  parts_.draw_ground(given_ground_, glm::vec3(1), clip_from_ws);
  set_look(given_character_, camera, look);
  parts_.draw_characters(given_character_, instances, clip_from_ws);
}

}  // namespace crowd::lab
