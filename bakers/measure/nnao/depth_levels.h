// The depth levels and the noise that XeGTAO reads.
#pragma once

#include "bakers/measure/nnao/gpu_image.h"

namespace nook::measure {

class DepthLevels {
 public:
  static constexpr int count = 5;

  DepthLevels(const GladGLContext& gl, int width, int height);
  ~DepthLevels();
  DepthLevels(const DepthLevels&) = delete;
  DepthLevels& operator=(const DepthLevels&) = delete;

  // radius_m and falloff: XeGTAO's tuned radius and its falloff range, a share of the radius. Needs a vertex
  // array.
  void draw(const GpuView& view, float radius_m, float falloff);
  GLuint texture() const { return texture_; }

 private:
  const GladGLContext& gl_;
  int width_, height_;
  GpuProgram program_;
  GLuint texture_ = 0, framebuffers_[count] = {};
};

// Places on a Hilbert curve over 64 x 64 pixels, 0 to 4095, one texel each (R32F).
GpuImage hilbert_image(const GladGLContext& gl);

}  // namespace nook::measure
