// Debug views that show how the occlusion of the crowd is computed. The shapes are plain lists, made only
// from data of the public interface. Your program can draw these lists itself.
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
  bool links = false;       // draws a line from each caster to each body that it darkens
  bool levels = false;      // colours each body by its level of detail
  bool error = false;       // colours bodies by the error of their AO relative to ray tracing
  // The number of bodies for which spheres, key points and errors are drawn. These are the bodies nearest to
  // the camera.
  std::uint32_t bodies = 1;
};

// Shapes are in world space, in metres. Colours are linear.
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

// Returns the `count` characters that are nearest to a point, the nearest first.
std::vector<std::uint32_t> nearest_characters(const CrowdScene& scene, const glm::vec3& to_ws,
                                              std::uint32_t count);

// Returns the AO of a character, as of the last update. Waits for the GPU.
std::vector<float> read_ao(const CrowdScene& scene, std::size_t character);

// Makes the shapes of a debug view. The shadows at key points are from the scene's last update on the CPU.
DebugShapes debug_shapes(const CrowdScene& scene, const DebugView& view, const glm::vec3& eye_ws);

// Returns the colour of a level of detail; 0 is the finest.
glm::vec3 level_colour(std::uint32_t level);
// A key point is dark blue if its shadow is 0, and yellow if its shadow is full_shadow or more.
inline constexpr float full_shadow = 0.25f;
glm::vec3 shadow_colour(float shadow);

// Draws debug views over a picture of the crowd.
class DebugRenderer {
 public:
  explicit DebugRenderer(const GladGLContext& gl);
  ~DebugRenderer();
  DebugRenderer(const DebugRenderer&) = delete;
  DebugRenderer& operator=(const DebugRenderer&) = delete;

  // The AO error at which the colour scale ends.
  static constexpr float full_error = 0.25f;

  // Draws into the bound framebuffer. Its depth buffer must still have the picture's depth. Proxy spheres are
  // visible through their body.
  void draw(const DebugShapes& shapes, const Camera& camera);
  // Draws the bodies again, coloured by their error. `ao` must have the error, which is Nook's AO minus the
  // true AO. Parts that are too bright become blue, and parts that are too dark become red.
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
  GLuint arrays_[2] = {};  // vertex arrays of balls and lines
  GLuint buffer_ = 0;
};

}  // namespace crowd::lab
