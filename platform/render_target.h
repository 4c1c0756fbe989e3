// The framebuffers that the samples draw into: an sRGB framebuffer, with four samples per pixel if OpenGL
// supports them, and another framebuffer, which gets the resolved picture.
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
  void bind() const;     // binds it for drawing, sets the viewport and sRGB encoding
  void resolve() const;  // leaves the resolved picture bound for reading
  // Resolves, waits for the GPU, and returns the rows from top to bottom.
  Image read() const;
  // Resolves to a framebuffer that shows bytes without conversion, such as a window's. The picture is
  // filtered if the sizes differ.
  void show(unsigned framebuffer, int width_px, int height_px) const;

 private:
  const Context& context_;
  int width_px_, height_px_;
  unsigned framebuffers_[2] = {};   // multisampled, resolved
  unsigned renderbuffers_[3] = {};  // colour, depth, resolved colour
};

}  // namespace platform
