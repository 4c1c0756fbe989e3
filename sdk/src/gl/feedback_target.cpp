#include "sdk/src/gl/feedback_target.h"

#include "sdk/src/core/failure.h"
#include "sdk/src/gl/state_guard.h"

namespace nook::gl {

FeedbackTarget::FeedbackTarget(Device& device) {
  const Functions& gl = device.gl;
  framebuffer_ = Object::make(device, Object::Kind::framebuffer);
  renderbuffer_ = Object::make(device, Object::Kind::renderbuffer);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  gl.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER,
                             renderbuffer_.name());
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Failure(NOOK_ERROR_GL, "a framebuffer with an RGBA8 renderbuffer is not complete (status 0x%04x)",
                  status);
  device.label(GL_FRAMEBUFFER, framebuffer_.name(), "nook: transform feedback");
  if (gl.BindTransformFeedback && gl.GenTransformFeedbacks && gl.DeleteTransformFeedbacks)
    feedback_ = Object::make(device, Object::Kind::transform_feedback);
}

void FeedbackTarget::begin(const Device& device) const {
  const Functions& gl = device.gl;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer_.name());
  if (feedback_.name()) gl.BindTransformFeedback(GL_TRANSFORM_FEEDBACK, feedback_.name());
  gl.Enable(GL_RASTERIZER_DISCARD);
  set_primitive_restart(gl, false);
}

void FeedbackTarget::end(const Device& device) {
  device.gl.Disable(GL_RASTERIZER_DISCARD);
  device.gl.BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, 0);
}

}  // namespace nook::gl
