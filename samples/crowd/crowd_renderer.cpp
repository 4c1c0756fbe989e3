#include "samples/crowd/crowd_renderer.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

namespace crowd {
namespace {

constexpr GLuint ao_slot = 4, light_slot = 5;

const char* const surface_fragment = R"(#version 330 core
in vec3 surface_normal_ws;
uniform float layer_weight;
layout(location = 0) out vec4 normal_ws;
layout(location = 1) out vec2 layer;
void main() {
  normal_ws = vec4(0.5 * normalize(surface_normal_ws) + 0.5, 1.0);
  layer = vec2(1.0, layer_weight);
}
)";

const char* const lit_fragment = R"(
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
  // RGB is the share of the soft light that remains after occlusion by characters and on the screen. Alpha is
  // the same share for the sun.
  vec4 open = mix(vec4(1.0), use_screen_ao ? fetch_screen_light() : vec4(1.0), ao_strength);
  vec3 irradiance = ground_irradiance * open.rgb + ground_sun_irradiance * open.a;
#else
  // Directional AO: the open share of each colour of the light.
  vec3 open = mix(vec3(1.0), surface_light, ao_strength);
  vec3 irradiance = nook_scene_irradiance(light, normalize(surface_normal_ws), open);
#endif
  vec3 seen = 1.0 - exp(-exposure * surface_albedo * irradiance * 0.31830989);
  float distance_m = length(surface_position_ws - eye_ws);
  float fog = 1.0 - exp(-max(distance_m - fog_start_m, 0.0) / (0.7 * fog_start_m));
  colour = vec4(mix(seen, background, fog), 1.0);
}
)";

}  // namespace

const char* const character_vertex = R"(#version 330 core
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
out vec3 surface_rest_m;
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
  surface_rest_m = position_m;
  gl_Position = clip_from_world * vec4(surface_position_ws, 1.0);
}
)";

const char* const ground_vertex = R"(#version 330 core
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

const char* const glsl_version = "#version 330 core\n";

const char* const fetch_screen_glsl = R"(
uniform bool use_screen_ao;
uniform sampler2D screen_ao;
uniform sampler2D screen_depth;
// The picture is multisampled and AO is not, so at an edge, the texel may belong to another surface. From
// this texel and the four texels beside it, the function takes the one whose depth is nearest to the
// fragment's depth.
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

Renderer::Renderer(const GladGLContext& gl, const Hero& hero)
    : gl_(gl),
      character_surface_(gl, {character_vertex}, {surface_fragment}),
      ground_surface_(gl, {ground_vertex}, {surface_fragment}),
      index_count_(GLsizei(hero.triangles.size())),
      bone_texels_(3 * std::size_t(hero.bone_count())) {
  gl.GenVertexArrays(2, arrays_);
  gl.GenBuffers(buffer_count, buffers_);
  gl.GenTextures(1, &bone_texture_);
  GLint texels = 65536;
  gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  chunk_ = std::max<std::size_t>(1, std::size_t(texels) / bone_texels_);
  make_character(hero);
}

Renderer::~Renderer() {
  gl_.DeleteVertexArrays(2, arrays_);
  gl_.DeleteBuffers(buffer_count, buffers_);
  gl_.DeleteTextures(1, &bone_texture_);
}

void Renderer::make_character(const Hero& hero) {
  gl_.BindVertexArray(arrays_[0]);
  const auto upload = [&](GLenum target, GLuint buffer, const auto& values) {
    gl_.BindBuffer(target, buffer);
    gl_.BufferData(target, GLsizeiptr(values.size() * sizeof values[0]), values.data(), GL_STATIC_DRAW);
  };
  for (GLuint slot = 0; slot < ao_slot; ++slot) gl_.EnableVertexAttribArray(slot);
  upload(GL_ARRAY_BUFFER, buffers_[positions], hero.positions_m);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  upload(GL_ARRAY_BUFFER, buffers_[normals], hero.normals);
  gl_.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
  upload(GL_ARRAY_BUFFER, buffers_[joints], hero.joints);
  gl_.VertexAttribIPointer(2, 4, GL_UNSIGNED_SHORT, 0, nullptr);
  upload(GL_ARRAY_BUFFER, buffers_[weights], hero.weights);
  gl_.VertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, 0, nullptr);
  upload(GL_ELEMENT_ARRAY_BUFFER, buffers_[triangles], hero.triangles);
}

void Renderer::upload_bones(std::span<const DrawnInstance> instances) {
  std::vector<float> bones;
  bones.reserve(instances.size() * 4 * bone_texels_);
  for (const DrawnInstance& instance : instances)
    bones.insert(bones.end(), instance.bones->begin(), instance.bones->end());
  gl_.BindBuffer(GL_TEXTURE_BUFFER, buffers_[bone_matrices]);
  gl_.BufferData(GL_TEXTURE_BUFFER, GLsizeiptr(bones.size() * sizeof(float)), bones.data(), GL_STREAM_DRAW);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_BUFFER, bone_texture_);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffers_[bone_matrices]);
}

// An engine binds the values of vertices like this. It binds AO, and directional AO if it uses Nook's lights.
void Renderer::bind_values(GLuint slot, GLint components, const VertexSource& values) {
  if (values.buffer == 0) {
    gl_.DisableVertexAttribArray(slot);
    gl_.VertexAttrib3f(slot, 1, 1, 1);  // fully open
    return;
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, values.buffer);
  gl_.EnableVertexAttribArray(slot);
  gl_.VertexAttribPointer(slot, components, GL_FLOAT, GL_FALSE, GLsizei(values.stride),
                          reinterpret_cast<const void*>(std::uintptr_t(values.offset)));
}

void Renderer::draw_characters(const platform::Program& program, std::span<const DrawnInstance> instances,
                               const glm::mat4& clip_from_ws) {
  program.use();
  gl_.Uniform1i(program.uniform("bones"), 0);
  gl_.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip_from_ws));
  const GLint first_texel = program.uniform("first_bone_texel"), light = program.uniform("light"),
              albedo = program.uniform("instance_albedo");
  gl_.BindVertexArray(arrays_[0]);
  for (std::size_t first = 0; first < instances.size(); first += chunk_) {
    const auto chunk = instances.subspan(first, std::min(chunk_, instances.size() - first));
    upload_bones(chunk);
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      bind_values(ao_slot, 1, chunk[i].ao);
      bind_values(light_slot, 3, chunk[i].light);
      gl_.Uniform1i(light, chunk[i].light_texel);
      gl_.Uniform1i(first_texel, GLint(i * bone_texels_));
      gl_.Uniform3fv(albedo, 1, glm::value_ptr(chunk[i].albedo));
      gl_.DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    }
  }
}

void Renderer::draw_ground(const platform::Program& program, const glm::vec3& albedo,
                           const glm::mat4& clip_from_ws) {
  program.use();
  gl_.UniformMatrix4fv(program.uniform("clip_from_world"), 1, GL_FALSE, glm::value_ptr(clip_from_ws));
  gl_.Uniform3fv(program.uniform("instance_albedo"), 1, glm::value_ptr(albedo));
  gl_.Uniform1f(program.uniform("ground_half_size_m"), 400.0f);
  gl_.BindVertexArray(arrays_[1]);
  gl_.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Renderer::draw_surfaces(std::span<const DrawnInstance> instances, const Camera& camera, float aspect) {
  gl_.Enable(GL_DEPTH_TEST);
  const glm::mat4 clip_from_ws = clip_from_world(camera, aspect);
  ground_surface_.use();
  gl_.Uniform1f(ground_surface_.uniform("layer_weight"), 0);
  draw_ground(ground_surface_, glm::vec3(0), clip_from_ws);
  character_surface_.use();
  gl_.Uniform1f(character_surface_.uniform("layer_weight"), 1);
  draw_characters(character_surface_, instances, clip_from_ws);
}

void Renderer::set_look(const platform::Program& program, const Camera& camera, const Look& look,
                        const glm::vec3& background) {
  program.use();
  const struct {
    GLint unit;
    GLenum target;
    GLuint texture;
    const char* name;
  } textures[] = {{2, GL_TEXTURE_2D, look.screen_ao.texture, "screen_ao"},
                  {3, GL_TEXTURE_2D, look.screen_ao.depth, "screen_depth"},
                  {5, GL_TEXTURE_BUFFER, look.lobes_texture, "nook_scene_lights"}};
  for (const auto& t : textures) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(t.unit));
    gl_.BindTexture(t.target, t.texture);
    gl_.Uniform1i(program.uniform(t.name), t.unit);
  }
  gl_.Uniform3fv(program.uniform("ground_irradiance"), 1, glm::value_ptr(look.light.soft_up));
  gl_.Uniform3fv(program.uniform("ground_sun_irradiance"), 1, glm::value_ptr(look.light.sun_up));
  gl_.Uniform1i(program.uniform("use_screen_ao"), look.screen_ao.texture != 0);
  gl_.Uniform1f(program.uniform("ao_strength"), look.ao_strength);
  gl_.Uniform1f(program.uniform("exposure"), look.light.exposure);
  gl_.Uniform1f(program.uniform("fog_start_m"), look.fog_start_m);
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
  gl_.Uniform3fv(program.uniform("background"), 1, glm::value_ptr(background));
}

// For Nook's lights, an engine adds look.glsl to its fragment shader and binds the texture of lights once
// (set_look). For each instance it sets the number of its light and binds its directional AO
// (draw_characters).
void Renderer::draw(std::span<const DrawnInstance> instances, const Camera& camera, const Look& look) {
  if (!character_) {
    character_.emplace(
        gl_, std::initializer_list<const char*>{character_vertex},
        std::initializer_list<const char*>{glsl_version, look.glsl, fetch_screen_glsl, lit_fragment});
    ground_.emplace(gl_, std::initializer_list<const char*>{ground_vertex},
                    std::initializer_list<const char*>{glsl_version, "#define GROUND\n", look.glsl,
                                                       fetch_screen_glsl, lit_fragment});
  }
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  gl_.Enable(GL_DEPTH_TEST);
  // The background is the light from the horizon in the view direction.
  glm::vec3 ahead = camera.target_ws - camera.eye_ws;
  ahead = glm::normalize(glm::vec3(ahead.x, 0.4f * glm::length(glm::vec2(ahead.x, ahead.z)), ahead.z));
  const glm::vec3 background = 1.0f - glm::exp(-look.light.exposure * look.light.radiance(ahead));
  gl_.ClearColor(background.r, background.g, background.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const glm::mat4 clip_from_ws = clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
  set_look(*ground_, camera, look, background);
  draw_ground(*ground_, ground_albedo, clip_from_ws);
  set_look(*character_, camera, look, background);
  draw_characters(*character_, instances, clip_from_ws);
}

}  // namespace crowd
