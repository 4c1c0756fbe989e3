// Debug views over the crowd that show how its occlusion arises. The shapes are plain lists, made from what
// the public interface tells about a scene. Programs draw these lists.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "samples/crowd/crowd_renderer.h"
#include "samples/crowd/crowd_scene.h"

namespace crowd::lab {

struct DebugView {
  bool spheres = false;     // the proxy spheres of bodies, coloured by bone
  bool key_points = false;  // the key points of bodies with their normals, coloured by their shadow
  bool links = false;       // a line from each caster to each body that it darkens
  bool levels = false;      // bodies in the colours of their levels of detail
  bool error = false;       // the AO of bodies against ray tracing
  // How many bodies show spheres, key points and errors, the nearest to the camera first.
  std::uint32_t bodies = 1;
};

// Shapes are in world space and metres; colours are linear.
struct Ball {
  glm::vec3 centre_ws;
  float radius_m;
  glm::vec3 colour;
};

struct Line {
  glm::vec3 from_ws;
  float from_width_px;
  glm::vec3 to_ws;
  float to_width_px;
  glm::vec3 colour;
};

struct DebugShapes {
  std::vector<Ball> spheres, key_points;
  std::vector<Line> normals, links;
};

// Returns at most `count` characters by their distance to a point.
std::vector<std::uint32_t> nearest_characters(const CrowdScene& scene, const glm::vec3& to_ws,
                                              std::uint32_t count);

// The AO of a character after the last update. Waits for the GPU.
std::vector<float> read_ao(const CrowdScene& scene, std::size_t character);

// Shadows at key points are from the scene's last update on the CPU.
DebugShapes debug_shapes(const CrowdScene& scene, const DebugView& view, const glm::vec3& eye_ws);

// Returns the colour of a level of detail; 0 is the finest.
glm::vec3 level_colour(std::uint32_t level);
// The colour of a shadow at a key point is dark blue at 0 and yellow from full_shadow on.
inline constexpr float full_shadow = 0.25f;
glm::vec3 shadow_colour(float shadow);

// Draws debug views over a picture of the crowd.
class DebugRenderer {
 public:
  explicit DebugRenderer(const GladGLContext& gl);
  ~DebugRenderer();
  DebugRenderer(const DebugRenderer&) = delete;
  DebugRenderer& operator=(const DebugRenderer&) = delete;

  // AO error at the end of the colours.
  static constexpr float full_error = 0.25f;

  // Draws into the bound framebuffer, which must still have the picture's depth. Proxy spheres show through
  // their body.
  void draw(const DebugShapes& shapes, const Camera& camera);
  // Draws bodies again in the colours of an error. `ao` is Nook's AO less the true AO: blue where the body is
  // too bright, red where it is too dark.
  void draw_errors(Renderer& renderer, std::span<const DrawnInstance> bodies, const Camera& camera);

 private:
  struct View {
    glm::mat4 clip_from_world;
    glm::vec3 eye_ws;
    glm::vec2 viewport_px;
  };
  View view_of(const Camera& camera) const;
  void set_view(const platform::Program& program, const View& view, float lift_m, float opacity) const;
  void draw_balls(const std::vector<Ball>& balls, const View& view, float lift_m, float opacity);
  void draw_lines(const std::vector<Line>& lines, const View& view, float lift_m);

  const GladGLContext& gl_;
  platform::Program ball_, line_, error_;
  GLuint arrays_[2] = {};  // for balls and lines
  GLuint buffer_ = 0;
};

}  // namespace crowd::lab
