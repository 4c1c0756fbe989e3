// Draws debug views over a picture of the crowd.
#pragma once

#include "samples/crowd/debug_shapes.h"
#include "samples/crowd/renderer.h"

namespace crowd {

class DebugRenderer {
 public:
  explicit DebugRenderer(const GladGLContext& gl);
  ~DebugRenderer();
  DebugRenderer(const DebugRenderer&) = delete;
  DebugRenderer& operator=(const DebugRenderer&) = delete;

  // The end of the colours of errors: AO.
  static constexpr float kFullError = 0.25f;

  // Draws into the framebuffer that is bound and still has the picture's depth. Proxy spheres show through
  // the body that they stand for.
  void draw(const DebugShapes& shapes, const Camera& camera);
  // Draws bodies again in the colours of an error. The values of `ao` are the AO of Nook less the true AO:
  // blue where the body is too bright, red where it is too dark.
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
  GLuint arrays_[2] = {};  // of balls and lines
  GLuint buffer_ = 0;
};

}  // namespace crowd
