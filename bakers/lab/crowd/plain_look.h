// Draws the crowd in plain ambient light times AO and a key light, for pictures that should show AO itself.
#pragma once

#include "samples/crowd/crowd_renderer.h"

namespace crowd::lab {

// A texture on a square of the ground, for example AO.
struct FloorTexture {
  GLuint texture = 0;                 // 0 if there is none; filtered linearly, clamped to its edge
  glm::vec2 first_m{0}, extent_m{1};  // x and z of the texture's corner, and its sides
};

struct PlainLook {
  float key_strength = 0.5f;
  glm::vec3 ground_albedo{::crowd::ground_albedo};
  glm::vec3 background{0.38f, 0.43f, 0.50f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
  FloorTexture floor_ao;  // 1 on its rim
};

class PlainRenderer {
 public:
  // Both must outlive this object.
  PlainRenderer(const GladGLContext& gl, Renderer& parts);
  ~PlainRenderer();
  PlainRenderer(const PlainRenderer&) = delete;
  PlainRenderer& operator=(const PlainRenderer&) = delete;

  // Draws into the bound framebuffer, whose viewport must be set. The shadow map covers shadow_radius_m
  // around shadow_centre_ws.
  void draw(std::span<const DrawnInstance> instances, const Camera& camera, const PlainLook& look,
            const glm::vec3& shadow_centre_ws, float shadow_radius_m);

 private:
  void draw_shadow_map(std::span<const DrawnInstance> instances);
  void set_look(const platform::Program& program, const Camera& camera, const PlainLook& look);

  const GladGLContext& gl_;
  Renderer& parts_;
  platform::Program character_, ground_, shadow_;
  GLuint shadow_texture_ = 0, shadow_framebuffer_ = 0;
  glm::vec3 to_key_ws_;
  glm::mat4 shadow_from_world_{1};
};

// The texture is bound as floor_ao or floor_light; the program is in use.
void set_floor(const GladGLContext& gl, const platform::Program& program, const FloorTexture& floor);

}  // namespace crowd::lab
