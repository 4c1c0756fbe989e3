#include "bakers/lab/crowd/plain_look.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

namespace crowd::lab {
namespace {

constexpr GLsizei shadow_size_px = 2048;

// Lights a surface with hemispherical ambient light, multiplied by AO, and with a key light that has a soft
// shadow map. The AO is from the vertices. With use_screen_ao, it is multiplied by screen-space AO. With
// use_floor_ao, it is multiplied on the ground by a texture.
const char* const plain_fragment = R"(
in vec3 surface_position_ws;
in vec3 surface_normal_ws;
in vec3 surface_albedo;
in float surface_ao;
uniform sampler2DShadow shadow_map;
uniform mat4 shadow_from_world;
uniform vec3 to_key_ws;
uniform float key_strength;
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
  float key = max(dot(n, to_key_ws), 0.0);
  if (key > 0.0 && key_strength > 0.0) key *= key_visibility(n);
  vec3 light = ambient * ao + key * key_strength * vec3(1.0, 0.95, 0.86);
  float distance_m = length(surface_position_ws - eye_ws);
  float fog = 1.0 - exp(-max(distance_m - fog_start_m, 0.0) / (0.7 * fog_start_m));
  colour = vec4(mix(surface_albedo * light, background, fog), 1.0);
}
)";

// Draws the shadow map of the key light, which contains only characters.
const char* const shadow_fragment = "#version 330 core\nvoid main() {}\n";

}  // namespace

PlainRenderer::PlainRenderer(const GladGLContext& gl, Renderer& parts)
    : gl_(gl),
      parts_(parts),
      character_(gl, {character_vertex}, {glsl_version, fetch_screen_glsl, plain_fragment}),
      ground_(gl, {ground_vertex}, {glsl_version, fetch_screen_glsl, plain_fragment}),
      shadow_(gl, {character_vertex}, {shadow_fragment}),
      to_key_ws_(glm::normalize(glm::vec3(0.5f, 0.95f, 0.35f))) {
  gl.GenTextures(1, &shadow_texture_);
  gl.BindTexture(GL_TEXTURE_2D, shadow_texture_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, shadow_size_px, shadow_size_px, 0, GL_DEPTH_COMPONENT,
                GL_UNSIGNED_INT, nullptr);
  for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, name, GL_LINEAR);
  for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.GenFramebuffers(1, &shadow_framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_texture_, 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
  gl.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

PlainRenderer::~PlainRenderer() {
  gl_.DeleteTextures(1, &shadow_texture_);
  gl_.DeleteFramebuffers(1, &shadow_framebuffer_);
}

void PlainRenderer::draw_shadow_map(std::span<const DrawnInstance> instances) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  gl_.Viewport(0, 0, shadow_size_px, shadow_size_px);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  parts_.draw_characters(shadow_, instances, shadow_from_world_);
}

void PlainRenderer::set_look(const platform::Program& program, const Camera& camera, const PlainLook& look) {
  program.use();
  gl_.ActiveTexture(GL_TEXTURE1);
  gl_.BindTexture(GL_TEXTURE_2D, shadow_texture_);
  gl_.Uniform1i(program.uniform("shadow_map"), 1);
  gl_.ActiveTexture(GL_TEXTURE2);
  gl_.BindTexture(GL_TEXTURE_2D, look.screen_ao.texture);
  gl_.Uniform1i(program.uniform("screen_ao"), 2);
  gl_.ActiveTexture(GL_TEXTURE3);
  gl_.BindTexture(GL_TEXTURE_2D, look.screen_ao.depth);
  gl_.Uniform1i(program.uniform("screen_depth"), 3);
  gl_.Uniform1i(program.uniform("use_screen_ao"), look.screen_ao.texture != 0);
  gl_.Uniform1i(program.uniform("floor_ao"), 4);
  gl_.UniformMatrix4fv(program.uniform("shadow_from_world"), 1, GL_FALSE, glm::value_ptr(shadow_from_world_));
  gl_.Uniform3fv(program.uniform("to_key_ws"), 1, glm::value_ptr(to_key_ws_));
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
  gl_.Uniform3fv(program.uniform("background"), 1, glm::value_ptr(look.background));
  gl_.Uniform1f(program.uniform("key_strength"), look.key_strength);
  gl_.Uniform1f(program.uniform("fog_start_m"), look.fog_start_m);
}

void PlainRenderer::draw(std::span<const DrawnInstance> instances, const Camera& camera,
                         const PlainLook& look, const glm::vec3& shadow_centre_ws, float shadow_radius_m) {
  GLint target = 0, viewport[4];
  gl_.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  gl_.Enable(GL_DEPTH_TEST);
  const float r = shadow_radius_m;
  shadow_from_world_ =
      glm::ortho(-r, r, -r, r, 0.0f, 4 * r) *
      glm::lookAt(shadow_centre_ws + 2 * r * to_key_ws_, shadow_centre_ws, glm::vec3(0, 0, 1));
  if (look.key_strength > 0) draw_shadow_map(instances);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, GLuint(target));
  gl_.Viewport(viewport[0], viewport[1], viewport[2], viewport[3]);
  gl_.ClearColor(look.background.r, look.background.g, look.background.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const glm::mat4 view = clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
  set_look(ground_, camera, look);
  gl_.Uniform1i(ground_.uniform("use_floor_ao"), look.floor_ao.texture != 0);
  set_floor(gl_, ground_, look.floor_ao);
  parts_.draw_ground(ground_, look.ground_albedo, view);
  set_look(character_, camera, look);
  parts_.draw_characters(character_, instances, view);
}

void set_floor(const GladGLContext& gl, const platform::Program& program, const FloorTexture& floor) {
  gl.ActiveTexture(GL_TEXTURE4);
  gl.BindTexture(GL_TEXTURE_2D, floor.texture);
  gl.Uniform2fv(program.uniform("floor_first_m"), 1, glm::value_ptr(floor.first_m));
  gl.Uniform2fv(program.uniform("floor_extent_m"), 1, glm::value_ptr(floor.extent_m));
}

}  // namespace crowd::lab
