// Draws the debug view of a scene over its picture. For the error view, it traces rays.
#pragma once

#include "bakers/lab/crowd/debug_shapes.h"

namespace crowd::lab {

// What a picture shows: the instances of a scene after an update, and the camera.
struct PictureOfCrowd {
  CrowdScene& scene;
  const Hero& hero;
  const std::vector<Bones>& poses;
  std::span<const DrawnInstance> drawn;
  const Camera& camera;
};

class DebugOverlay {
 public:
  // gl must outlive this object.
  explicit DebugOverlay(const GladGLContext& gl);
  ~DebugOverlay();
  DebugOverlay(const DebugOverlay&) = delete;
  DebugOverlay& operator=(const DebugOverlay&) = delete;

  // Draws over the picture in the bound framebuffer.
  void draw(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view);

 private:
  void draw_errors(Renderer& renderer, const PictureOfCrowd& picture, std::uint32_t count);

  const GladGLContext& gl_;
  DebugRenderer shapes_;
  GLuint error_buffer_ = 0;
};

// Colours each instance by its level of detail.
void colour_by_level(const CrowdScene& scene, std::span<DrawnInstance> drawn);

}  // namespace crowd::lab
