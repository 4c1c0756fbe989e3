// The framebuffers of the samples: an sRGB framebuffer with four samples if OpenGL supports them, and the one
// it is resolved to.
#pragma once

#include "platform/platform.h"

namespace platform {

class RenderTarget {
 public:
  RenderTarget(const Context& context, int width_px, int height_px);
  ~RenderTarget();
  RenderTarget(const RenderTarget&) = delete;
  RenderTarget& operator=(const RenderTarget&) = delete;

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  void bind() const;     // for drawing, with viewport and sRGB encoding set
  void resolve() const;  // leaves the resolved picture bound for reading
  // Resolves, waits for the GPU, and returns rows from top to bottom.
  Image read() const;
  // Resolves onto a framebuffer that shows its bytes unchanged, such as a window's. The picture is filtered
  // if the sizes differ.
  void show(unsigned framebuffer, int width_px, int height_px) const;

 private:
  const Context& context_;
  int width_px_, height_px_;
  unsigned framebuffers_[2] = {};   // multisampled, resolved
  unsigned renderbuffers_[3] = {};  // colour, depth, resolved colour
};

}  // namespace platform
