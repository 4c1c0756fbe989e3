// The framebuffers of the samples. Samples draw into an sRGB framebuffer, which has four samples per pixel if
// OpenGL supports them. The image is then resolved to a second framebuffer.
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
  void bind() const;     // binds the target for drawing, sets the viewport, and enables sRGB encoding
  void resolve() const;  // resolves the image, and leaves the resolved framebuffer bound for reading
  // Resolves the image and reads it back, with rows from top to bottom. Waits for the GPU.
  Image read() const;
  // Resolves the image and copies it to a framebuffer that shows bytes without conversion, such as a
  // window's. If the sizes differ, the image is filtered.
  void show(unsigned framebuffer, int width_px, int height_px) const;

 private:
  const Context& context_;
  int width_px_, height_px_;
  unsigned framebuffers_[2] = {};   // the multisampled one, the resolved one
  unsigned renderbuffers_[3] = {};  // colour, depth, resolved colour
};

}  // namespace platform
