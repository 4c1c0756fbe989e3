// The debug view of a scene over its picture, and the ray tracing that the view of errors needs.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "samples/crowd/debug_renderer.h"
#include "samples/crowd/traced_ao.h"

namespace crowd {

// The content of a picture: the instances of a scene after an update, and the camera.
struct PictureOfCrowd {
  CrowdScene& scene;
  const std::vector<Bones>& poses;
  std::span<const DrawnInstance> drawn;
  const Camera& camera;
};

class DebugOverlay {
 public:
  // Both must outlive this object.
  DebugOverlay(const GladGLContext& gl, const Hero& hero);
  ~DebugOverlay();
  DebugOverlay(const DebugOverlay&) = delete;
  DebugOverlay& operator=(const DebugOverlay&) = delete;

  // Draws over the picture in the framebuffer that is bound. Errors are drawn where ray tracing is done;
  // with wait_for_rays, that is everywhere.
  void draw(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view, bool wait_for_rays);

  // True if the last draw lacked nothing.
  bool is_complete() const { return is_complete_; }
  // A line for the user about the errors of the last draw, or an empty text.
  const std::string& error_text() const { return error_text_; }

 private:
  void trace_missing(const PictureOfCrowd& picture, const std::vector<std::uint32_t>& characters, bool wait);
  void draw_errors(Renderer& renderer, const PictureOfCrowd& picture, const DebugView& view, bool wait);

  const GladGLContext& gl_;
  const Hero& hero_;
  DebugRenderer shapes_;
  GLuint error_buffer_ = 0;
  std::vector<Bones> traced_poses_;
  std::map<std::uint32_t, std::vector<float>> truth_;  // of traced_poses_
  std::unique_ptr<TracedAo> tracing_;                  // of traced_poses_, or null
  bool is_complete_ = true;
  std::string error_text_;
};

// Gives the instances the colours of their levels of detail.
void colour_by_level(const CrowdScene& scene, std::span<DrawnInstance> drawn);

}  // namespace crowd
