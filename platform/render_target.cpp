#include "platform/render_target.h"

#include <glad/gl.h>

#include <stdexcept>

namespace platform {
namespace {

void attach(const GladGLContext& gl, GLuint renderbuffer, GLenum attachment, GLenum format, GLint samples,
            int width, int height) {
  gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer);
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, renderbuffer);
}

void require_complete(const GladGLContext& gl) {
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error(
        "RenderTarget: this OpenGL cannot draw into an sRGB framebuffer; use another driver");
}

}  // namespace

RenderTarget::RenderTarget(const Context& context, int width_px, int height_px)
    : context_(context), width_px_(width_px), height_px_(height_px) {
  const GladGLContext& gl = context.gl();
  GLint max_samples = 0;
  gl.GetIntegerv(GL_MAX_SAMPLES, &max_samples);
  // Mesa's softpipe does not support multisampling, so it gets a framebuffer without samples.
  const GLint samples = max_samples >= 4 ? 4 : 0;
  gl.GenFramebuffers(2, framebuffers_);
  gl.GenRenderbuffers(3, renderbuffers_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
  attach(gl, renderbuffers_[0], GL_COLOR_ATTACHMENT0, GL_SRGB8_ALPHA8, samples, width_px, height_px);
  attach(gl, renderbuffers_[1], GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, samples, width_px, height_px);
  require_complete(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[1]);
  attach(gl, renderbuffers_[2], GL_COLOR_ATTACHMENT0, GL_SRGB8_ALPHA8, 0, width_px, height_px);
  require_complete(gl);
}

RenderTarget::~RenderTarget() {
  context_.gl().DeleteFramebuffers(2, framebuffers_);
  context_.gl().DeleteRenderbuffers(3, renderbuffers_);
}

void RenderTarget::bind() const {
  const GladGLContext& gl = context_.gl();
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffers_[0]);
  gl.Viewport(0, 0, width_px_, height_px_);
  gl.Enable(GL_FRAMEBUFFER_SRGB);
  gl.Enable(GL_MULTISAMPLE);
}

void RenderTarget::resolve() const {
  const GladGLContext& gl = context_.gl();
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[0]);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffers_[1]);
  gl.BlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_COLOR_BUFFER_BIT,
                     GL_NEAREST);
  gl.BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers_[1]);
}

Image RenderTarget::read() const {
  resolve();
  return read_pixels(context_, width_px_, height_px_);
}

void RenderTarget::show(unsigned framebuffer, int width_px, int height_px) const {
  resolve();
  const GladGLContext& gl = context_.gl();
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
  // The pixels are already sRGB-encoded.
  gl.Disable(GL_FRAMEBUFFER_SRGB);
  gl.BlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px, height_px, GL_COLOR_BUFFER_BIT, GL_LINEAR);
}

}  // namespace platform
