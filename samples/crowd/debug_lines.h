// The occluders of the crowd, as lines over its picture: what nook_debug.h tells of a scene.
#pragma once

#include "samples/crowd/crowd_scene.h"

namespace crowd {

struct DebugView {
  bool spheres = false;  // the proxy spheres of bodies, coloured by bone
  bool links = false;    // a line from each caster to each body that it darkens
  int bodies = 1;        // the bodies that spheres are shown for, the nearest to the camera first
};

class DebugLines {
 public:
  explicit DebugLines(const GladGLContext& gl);
  ~DebugLines();
  DebugLines(const DebugLines&) = delete;
  DebugLines& operator=(const DebugLines&) = delete;

  // Draws into the framebuffer that is bound, over everything. The parts are those of the last update.
  void draw(const CrowdScene& scene, const Camera& camera, float aspect, const DebugView& view);

 private:
  const GladGLContext& gl_;
  platform::Program program_;
  GLuint array_ = 0, buffer_ = 0;
};

}  // namespace crowd
