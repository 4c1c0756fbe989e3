// The objects of draws whose results are captured by transform feedback alone.
#pragma once

#include "sdk/src/gl/object.h"

namespace nook::gl {

// A draw needs a complete framebuffer even if nothing is rasterised, and a surfaceless context has none.
class FeedbackTarget {
 public:
  FeedbackTarget() = default;
  // Binds GL_DRAW_FRAMEBUFFER and GL_RENDERBUFFER. Throws Failure.
  explicit FeedbackTarget(Device& device);

  // Binds the framebuffer and the transform-feedback object, and turns rasterization and primitive restart
  // off. end turns rasterization on, and unbinds the buffer that was written.
  void begin(const Device& device) const;
  static void end(const Device& device);

 private:
  Object framebuffer_, renderbuffer_;
  Object feedback_;  // name 0 before OpenGL 4.0
};

}  // namespace nook::gl
