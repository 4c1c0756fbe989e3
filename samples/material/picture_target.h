// What the pictures are drawn into: an sRGB framebuffer of four samples where OpenGL has them.
#pragma once

#include "platform/platform.h"

namespace material {

class PictureTarget {
 public:
  PictureTarget(const platform::Context& context, int width_px, int height_px);
  ~PictureTarget();
  PictureTarget(const PictureTarget&) = delete;
  PictureTarget& operator=(const PictureTarget&) = delete;

  // Bound for drawing, cleared to the background.
  void begin() const;
  // Resolves, waits for the GPU.
  platform::Image read() const;
  // Onto the framebuffer that a window shows.
  void show(unsigned framebuffer, int width_px, int height_px) const;

 private:
  void resolve() const;

  const platform::Context& context_;
  int width_px_, height_px_;
  unsigned framebuffers_[2] = {};   // of samples, resolved
  unsigned renderbuffers_[3] = {};  // colour, depth, resolved colour
};

}  // namespace material
