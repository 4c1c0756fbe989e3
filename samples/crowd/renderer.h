// Draws skinned instances of one character on a ground plane. Nook's values come in as vertex attributes.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "platform/program.h"
#include "samples/crowd/camera.h"
#include "samples/crowd/hero.h"

namespace crowd {

// Where the values of an instance's vertices lie. Nook's views of an instance have these fields.
struct VertexSource {
  GLuint buffer = 0;  // 0 if there is none
  std::uint64_t offset = 0;
  std::uint32_t stride = sizeof(float);
};

struct DrawnInstance {
  const Bones* bones = nullptr;
  VertexSource ao;  // one float for each vertex; without a buffer the instance is fully open
  glm::vec3 albedo{0.6f};
  VertexSource light;     // three floats for each vertex: directional AO, or an irradiance that is given
  GLint light_texel = 0;  // where Nook's view has the instance's light
};

// The result of the passes over the screen for the same instances through the same camera.
struct ScreenAo {
  // 0 if there was no such pass. Red is AO; under a probe's light red, green and blue are the open shares of
  // soft light, and alpha is that of the sun.
  GLuint texture = 0;
  GLuint depth = 0;  // single-sampled, as large as the viewport
};

// A texture that lies on a square of the ground, such as AO that was made elsewhere.
struct FloorTexture {
  GLuint texture = 0;                 // 0 if there is none; filtered linearly, clamped to its edge
  glm::vec2 first_m{0}, extent_m{1};  // x and z of the texture's corner, and its sides
};

// The look of a picture in ambient light and a key light.
struct Look {
  float key_strength = 0.5f;
  float ao_strength = 1.0f;
  glm::vec3 ground_albedo{0.36f, 0.36f, 0.37f};
  glm::vec3 background{0.38f, 0.43f, 0.50f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
  FloorTexture floor_ao;  // 1 on its rim
};

// A probe's light as Nook leaves it on the GPU, and the look of a picture in it.
struct ProbeLight {
  GLuint texture = 0;          // of the lights
  const char* glsl = nullptr;  // that reads the texture
  // On open ground. The ground is flat, so that no pixel of it evaluates the lobes.
  glm::vec3 ground_irradiance{1};
  glm::vec3 ground_sun_irradiance{0};  // of the light whose open share is the alpha of screen_ao
  float exposure = 1;                  // of radiance, before bright parts are rolled off
  float ao_strength = 1;
  glm::vec3 horizon{0.5f};  // radiance behind everything
  glm::vec3 ground_albedo{0.36f, 0.36f, 0.37f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
};

class Renderer {
 public:
  Renderer(const GladGLContext& gl, const Hero& hero);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Draws depth, normals and the layer of the screen-space pass (kSurfaceFragment) into the framebuffer that
  // is bound, which is cleared and has its viewport set.
  void draw_surfaces(std::span<const DrawnInstance> instances, const Camera& camera, float aspect);
  // Draws into the framebuffer that is bound, whose viewport is set. The shadow map covers shadow_radius_m
  // round shadow_centre_ws.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const Look& look,
            const glm::vec3& shadow_centre_ws, float shadow_radius_m);
  // The same in a probe's light: its irradiance times directional AO, on the ground times the AO of
  // light.screen_ao.
  void draw_probe_light(std::span<const DrawnInstance> instances, const Camera& camera,
                        const ProbeLight& light);

  // Parts of a picture, for programs that are made elsewhere from kCharacterVertex and kGroundVertex. Each
  // uses the program and sets the uniforms of its vertex shader.
  void draw_characters(const platform::Program& program, std::span<const DrawnInstance> instances,
                       const glm::mat4& clip_from_ws);
  void draw_ground(const platform::Program& program, const glm::vec3& albedo, const glm::mat4& clip_from_ws);

 private:
  void make_character(const Hero& hero);
  void make_shadow_map();
  void bind_values(GLuint slot, GLint components, const VertexSource& values);
  void upload_bones(std::span<const DrawnInstance> instances);
  void draw_shadow_map(std::span<const DrawnInstance> instances);
  void set_look(const platform::Program& program, const Camera& camera, const Look& look);
  void set_probe_light(const platform::Program& program, const Camera& camera, const ProbeLight& light,
                       const glm::vec3& background);

  const GladGLContext& gl_;
  platform::Program character_, ground_, character_surface_, ground_surface_, shadow_;
  std::optional<platform::Program> character_probe_light_, ground_probe_light_;  // made for the first light
  GLsizei index_count_;
  std::size_t bone_texels_;
  GLuint arrays_[2] = {};   // character, ground
  GLuint buffers_[3] = {};  // vertices, indices, bones
  GLuint bone_texture_ = 0, shadow_texture_ = 0, shadow_framebuffer_ = 0;
  std::size_t chunk_ = 1;  // instances whose bones fit into one texture buffer
  glm::vec3 to_key_ws_;
  glm::mat4 shadow_from_world_{1};
};

}  // namespace crowd
