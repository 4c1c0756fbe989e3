// Draws skinned instances of one character with their ambient occlusion as a vertex attribute.
#pragma once

#include <glad/gl.h>

#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "samples/crowd/camera.h"
#include "samples/crowd/gpu_program.h"
#include "samples/crowd/hero.h"

namespace crowd {

// Where an instance's AO lies; buffer 0 means fully open. Nook's view of an instance has these fields.
struct AoSource {
  GLuint buffer = 0;
  std::uint64_t offset = 0;
  std::uint32_t stride = sizeof(float);
};

struct DrawnInstance {
  const Bones* bones = nullptr;
  AoSource ao;
  glm::vec3 albedo{0.6f};
  AoSource
      light;  // three floats a vertex: irradiance for draw_given_light, directional AO for draw_probe_light
  GLint light_texel = 0;  // of Nook's view of its light; for draw_probe_light
};

// What the screen-space pass made of the same instances through the same camera; 0: no such pass.
struct ScreenAo {
  GLuint texture = 0;
  GLuint depth = 0;  // single-sampled, of the viewport's size
};

// AO, or light, of a square of the ground that was made elsewhere, AO 1 on its rim; 0: none.
struct FloorAo {
  GLuint texture = 0;                 // linear filter, clamped to its edge
  glm::vec2 first_m{0}, extent_m{1};  // x and z of the texture's corner, its sides
};

struct Look {
  float key_strength = 0.5f;
  float ao_strength = 1.0f;
  glm::vec3 ground_albedo{0.36f, 0.36f, 0.37f};
  glm::vec3 background{0.38f, 0.43f, 0.50f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
  FloorAo floor_ao;
};

// For surfaces whose irradiance is given.
struct GivenLight {
  float exposure = 1;  // of radiance, before the roll-off
  FloorAo floor;       // irradiance, RGB; 0: no floor is drawn
  glm::vec3 background{0.62f};
};

// A probe's light as Nook leaves it on the GPU.
struct ProbeLight {
  GLuint texture = 0;  // of the lights
  const char* glsl = nullptr;
  glm::vec3 ground_irradiance{1};  // on open ground, which is flat: no pixel looks at the lobes
  float exposure = 1;              // of radiance, before the roll-off
  float ao_strength = 1;
  glm::vec3 horizon{0.5f};  // radiance behind everything
  glm::vec3 ground_albedo{0.36f, 0.36f, 0.37f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
  FloorAo floor;  // what the bodies leave of the ground's irradiance, RGB
};

class Renderer {
 public:
  Renderer(const GladGLContext& gl, const Hero& hero);
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  // Depth, normals and the layer of the screen-space pass (kSurfaceFragment) into the framebuffer that is
  // bound, cleared and has its viewport set.
  void draw_surfaces(std::span<const DrawnInstance> instances, const Camera& camera, float aspect);
  // Draws into the framebuffer that is bound, whose viewport is set; the shadow map covers shadow_radius_m
  // round the origin of shadow_centre_ws.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const Look& look,
            const glm::vec3& shadow_centre_ws, float shadow_radius_m);
  // The same with nothing but the instances' irradiance and the floor's.
  void draw_given_light(std::span<const DrawnInstance> instances, const Camera& camera,
                        const GivenLight& light);
  // The same with a probe's irradiance times directional AO, which on the ground is the floor's or the
  // screen's, whichever is darker.
  void draw_probe_light(std::span<const DrawnInstance> instances, const Camera& camera,
                        const ProbeLight& light);

 private:
  void bind_light(const AoSource& light);
  void upload_bones(std::span<const DrawnInstance> instances);
  void draw_characters(const GpuProgram& program, std::span<const DrawnInstance> instances,
                       const glm::mat4& view);
  void draw_ground(const GpuProgram& program, const glm::vec3& albedo, const glm::mat4& view);
  void draw_shadow_map(std::span<const DrawnInstance> instances);
  void set_look(const GpuProgram& program, const Camera& camera, const Look& look);

  const GladGLContext& gl_;
  GpuProgram character_, ground_, character_surface_, ground_surface_, shadow_;
  GpuProgram character_given_light_, ground_given_light_;
  std::unique_ptr<GpuProgram> character_probe_light_, ground_probe_light_;  // none before the first
  GLsizei index_count_;
  std::size_t bone_texels_;
  GLuint arrays_[2] = {};   // character, ground
  GLuint buffers_[3] = {};  // vertices, indices, bones
  GLuint bone_texture_ = 0, shadow_texture_ = 0, shadow_framebuffer_ = 0;
  std::size_t chunk_ = 1;  // instances whose bones fit into one texture buffer
  glm::vec3 to_key_ws_;
  glm::mat4 shadow_from_world_{1.0f};
};

}  // namespace crowd
