// Draws the crowd with plain ambient light, multiplied by AO, and a key light. Use it for pictures that
// should show the AO itself.
#pragma once

#include "samples/crowd/crowd_renderer.h"

namespace crowd::lab {

// A texture, for example AO, that covers a square of the ground.
struct FloorTexture {
  GLuint texture = 0;                 // 0: no texture; must be filtered linearly and clamped to its edge
  glm::vec2 first_m{0}, extent_m{1};  // x and z of the texture's corner, and the lengths of its sides
};

struct PlainLook {
  float key_strength = 0.5f;
  glm::vec3 ground_albedo{::crowd::ground_albedo};
  glm::vec3 background{0.38f, 0.43f, 0.50f};
  float fog_start_m = 22;
  ScreenAo screen_ao;
  FloorTexture floor_ao;  // its border must be 1
};

class PlainRenderer {
 public:
  // Both must outlive this object.
  PlainRenderer(const GladGLContext& gl, Renderer& parts);
  ~PlainRenderer();
  PlainRenderer(const PlainRenderer&) = delete;
  PlainRenderer& operator=(const PlainRenderer&) = delete;

  // Draws into the bound framebuffer. Set the viewport before the call. The shadow map covers shadow_radius_m
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

// Sets the floor uniforms of `program`. Before the call, use the program and bind the texture as floor_ao or
// floor_light.
void set_floor(const GladGLContext& gl, const platform::Program& program, const FloorTexture& floor);

}  // namespace crowd::lab
