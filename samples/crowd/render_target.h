// What the pictures are drawn into: a multisampled sRGB framebuffer and the one it is resolved to.
#pragma once

#include "platform/platform.h"

namespace crowd {

class RenderTarget {
 public:
  RenderTarget(const platform::Context& context, int width_px, int height_px);
  ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  void bind() const;     // for drawing, viewport and sRGB encoding set
  void resolve() const;  // leaves the resolved picture bound for reading
  // Resolves, waits for the GPU, returns rows from top to bottom.
  platform::Image read() const;

 private:
  const platform::Context& context_;
  int width_px_, height_px_;
  unsigned framebuffers_[2] = {};   // multisampled, resolved
  unsigned renderbuffers_[3] = {};  // colour, depth, resolved colour
};

}  // namespace crowd
