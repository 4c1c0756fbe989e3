#include "samples/crowd/renderer.h"

#include <algorithm>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include "samples/crowd/shaders.h"

namespace crowd {
namespace {

constexpr GLsizei kShadowSize_px = 2048;
constexpr GLuint kAoSlot = 4, kLightSlot = 5;

struct Vertex {
  float position_m[3];
  float normal[3];
  std::uint16_t joints[4];
  float weights[4];
};

std::vector<Vertex> interleave(const Hero& hero) {
  std::vector<Vertex> vertices(hero.vertex_count());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    std::copy_n(&hero.positions_m[3 * i], 3, vertices[i].position_m);
    std::copy_n(&hero.normals[3 * i], 3, vertices[i].normal);
    std::copy_n(&hero.joints[4 * i], 4, vertices[i].joints);
    std::copy_n(&hero.weights[4 * i], 4, vertices[i].weights);
  }
  return vertices;
}

const void* at(std::uint64_t offset) {
  return reinterpret_cast<const void*>(static_cast<std::uintptr_t>(offset));
}

}  // namespace

Renderer::Renderer(const GladGLContext& gl, const Hero& hero)
    : gl_(gl),
      character_(gl, {kCharacterVertex}, {kVersion, kScreenAo, kLitFragment}),
      ground_(gl, {kGroundVertex}, {kVersion, kScreenAo, kLitFragment}),
      character_surface_(gl, {kCharacterVertex}, {kSurfaceFragment}),
      ground_surface_(gl, {kGroundVertex}, {kSurfaceFragment}),
      shadow_(gl, {kCharacterVertex}, {kShadowFragment}),
      index_count_(GLsizei(hero.triangles.size())),
      bone_texels_(3 * std::size_t(hero.bone_count())),
      to_key_ws_(glm::normalize(glm::vec3(0.5f, 0.95f, 0.35f))) {
  gl.GenVertexArrays(2, arrays_);
  gl.GenBuffers(3, buffers_);
  gl.GenTextures(1, &bone_texture_);
  GLint texels = 65536;
  gl.GetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
  chunk_ = std::max<std::size_t>(1, std::size_t(texels) / bone_texels_);
  make_character(hero);
  make_shadow_map();
}

void Renderer::make_character(const Hero& hero) {
  const std::vector<Vertex> vertices = interleave(hero);
  gl_.BindVertexArray(arrays_[0]);
  gl_.BindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  gl_.BufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(),
                 GL_STATIC_DRAW);
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(4 * hero.triangles.size()), hero.triangles.data(),
                 GL_STATIC_DRAW);
  for (GLuint slot = 0; slot < kAoSlot; ++slot) gl_.EnableVertexAttribArray(slot);
  gl_.VertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), at(offsetof(Vertex, position_m)));
  gl_.VertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex), at(offsetof(Vertex, normal)));
  gl_.VertexAttribIPointer(2, 4, GL_UNSIGNED_SHORT, sizeof(Vertex), at(offsetof(Vertex, joints)));
  gl_.VertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, sizeof(Vertex), at(offsetof(Vertex, weights)));
}

void Renderer::make_shadow_map() {
  gl_.GenTextures(1, &shadow_texture_);
  gl_.BindTexture(GL_TEXTURE_2D, shadow_texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, kShadowSize_px, kShadowSize_px, 0,
                 GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, nullptr);
  for (const GLenum name : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl_.TexParameteri(GL_TEXTURE_2D, name, GL_LINEAR);
  for (const GLenum name : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl_.TexParameteri(GL_TEXTURE_2D, name, GL_CLAMP_TO_EDGE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.GenFramebuffers(1, &shadow_framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_texture_, 0);
  gl_.DrawBuffer(GL_NONE);
  gl_.ReadBuffer(GL_NONE);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, 0);
}

Renderer::~Renderer() {
  gl_.DeleteVertexArrays(2, arrays_);
  gl_.DeleteBuffers(3, buffers_);
  gl_.DeleteTextures(1, &bone_texture_);
  gl_.DeleteTextures(1, &shadow_texture_);
  gl_.DeleteFramebuffers(1, &shadow_framebuffer_);
}

void Renderer::upload_bones(std::span<const DrawnInstance> instances) {
  std::vector<float> bones;
  bones.reserve(instances.size() * 4 * bone_texels_);
  for (const DrawnInstance& instance : instances)
    bones.insert(bones.end(), instance.bones->begin(), instance.bones->end());
  gl_.BindBuffer(GL_TEXTURE_BUFFER, buffers_[2]);
  gl_.BufferData(GL_TEXTURE_BUFFER, GLsizeiptr(bones.size() * sizeof(float)), bones.data(), GL_STREAM_DRAW);
  gl_.ActiveTexture(GL_TEXTURE0);
  gl_.BindTexture(GL_TEXTURE_BUFFER, bone_texture_);
  gl_.TexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, buffers_[2]);
}

// This is all that an engine does with Nook's buffers.
void Renderer::bind_values(GLuint slot, GLint components, const VertexSource& values) {
  if (values.buffer == 0) {
    gl_.DisableVertexAttribArray(slot);
    gl_.VertexAttrib3f(slot, 1, 1, 1);  // fully open
    return;
  }
  gl_.BindBuffer(GL_ARRAY_BUFFER, values.buffer);
  gl_.EnableVertexAttribArray(slot);
  gl_.VertexAttribPointer(slot, components, GL_FLOAT, GL_FALSE, GLsizei(values.stride), at(values.offset));
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
      bind_values(kAoSlot, 1, chunk[i].ao);
      bind_values(kLightSlot, 3, chunk[i].light);
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
  const glm::mat4 view = clip_from_world(camera, aspect);
  ground_surface_.use();
  gl_.Uniform1f(ground_surface_.uniform("layer_weight"), 0);
  draw_ground(ground_surface_, glm::vec3(0), view);
  character_surface_.use();
  gl_.Uniform1f(character_surface_.uniform("layer_weight"), 1);
  draw_characters(character_surface_, instances, view);
}

void Renderer::draw_shadow_map(std::span<const DrawnInstance> instances) {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_);
  gl_.Viewport(0, 0, kShadowSize_px, kShadowSize_px);
  gl_.Clear(GL_DEPTH_BUFFER_BIT);
  draw_characters(shadow_, instances, shadow_from_world_);
}

void Renderer::set_look(const platform::Program& program, const Camera& camera, const Look& look) {
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
  gl_.ActiveTexture(GL_TEXTURE4);
  gl_.BindTexture(GL_TEXTURE_2D, look.floor_ao.texture);
  gl_.Uniform1i(program.uniform("floor_ao"), 4);
  gl_.UniformMatrix4fv(program.uniform("shadow_from_world"), 1, GL_FALSE, glm::value_ptr(shadow_from_world_));
  gl_.Uniform3fv(program.uniform("to_key_ws"), 1, glm::value_ptr(to_key_ws_));
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
  gl_.Uniform3fv(program.uniform("background"), 1, glm::value_ptr(look.background));
  gl_.Uniform1f(program.uniform("key_strength"), look.key_strength);
  gl_.Uniform1f(program.uniform("ao_strength"), look.ao_strength);
  gl_.Uniform1f(program.uniform("fog_start_m"), look.fog_start_m);
}

void Renderer::draw(std::span<const DrawnInstance> instances, const Camera& camera, const Look& look,
                    const glm::vec3& shadow_centre_ws, float shadow_radius_m) {
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
  gl_.Uniform2fv(ground_.uniform("floor_first_m"), 1, glm::value_ptr(look.floor_ao.first_m));
  gl_.Uniform2fv(ground_.uniform("floor_extent_m"), 1, glm::value_ptr(look.floor_ao.extent_m));
  draw_ground(ground_, look.ground_albedo, view);
  set_look(character_, camera, look);
  draw_characters(character_, instances, view);
}

void Renderer::set_probe_light(const platform::Program& program, const Camera& camera,
                               const ProbeLight& light, const glm::vec3& background) {
  program.use();
  const struct {
    GLint unit;
    GLenum target;
    GLuint texture;
    const char* name;
  } textures[] = {{2, GL_TEXTURE_2D, light.screen_ao.texture, "screen_ao"},
                  {3, GL_TEXTURE_2D, light.screen_ao.depth, "screen_depth"},
                  {5, GL_TEXTURE_BUFFER, light.texture, "nook_scene_lights"}};
  for (const auto& t : textures) {
    gl_.ActiveTexture(GL_TEXTURE0 + GLenum(t.unit));
    gl_.BindTexture(t.target, t.texture);
    gl_.Uniform1i(program.uniform(t.name), t.unit);
  }
  gl_.Uniform3fv(program.uniform("ground_irradiance"), 1, glm::value_ptr(light.ground_irradiance));
  gl_.Uniform3fv(program.uniform("ground_sun_irradiance"), 1, glm::value_ptr(light.ground_sun_irradiance));
  gl_.Uniform1i(program.uniform("use_screen_ao"), light.screen_ao.texture != 0);
  gl_.Uniform1f(program.uniform("ao_strength"), light.ao_strength);
  gl_.Uniform1f(program.uniform("exposure"), light.exposure);
  gl_.Uniform1f(program.uniform("fog_start_m"), light.fog_start_m);
  gl_.Uniform3fv(program.uniform("eye_ws"), 1, glm::value_ptr(camera.eye_ws));
  gl_.Uniform3fv(program.uniform("background"), 1, glm::value_ptr(background));
}

// An engine does no more with Nook's lights: it binds their texture, and for each instance it sets the number
// of its light and binds its directional AO.
void Renderer::draw_probe_light(std::span<const DrawnInstance> instances, const Camera& camera,
                                const ProbeLight& light) {
  GLint viewport[4];
  gl_.GetIntegerv(GL_VIEWPORT, viewport);
  if (!character_probe_light_) {
    character_probe_light_.emplace(
        gl_, std::initializer_list<const char*>{kCharacterVertex},
        std::initializer_list<const char*>{kVersion, light.glsl, kScreenAo, kProbeLightFragment});
    ground_probe_light_.emplace(gl_, std::initializer_list<const char*>{kGroundVertex},
                                std::initializer_list<const char*>{kVersion, "#define GROUND\n", light.glsl,
                                                                   kScreenAo, kProbeLightFragment});
  }
  gl_.Enable(GL_DEPTH_TEST);
  const glm::vec3 background = 1.0f - glm::exp(-light.exposure * light.horizon);
  gl_.ClearColor(background.r, background.g, background.b, 1);
  gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const glm::mat4 view = clip_from_world(camera, float(viewport[2]) / float(viewport[3]));
  set_probe_light(*ground_probe_light_, camera, light, background);
  draw_ground(*ground_probe_light_, light.ground_albedo, view);
  set_probe_light(*character_probe_light_, camera, light, background);
  draw_characters(*character_probe_light_, instances, view);
}

}  // namespace crowd
