#include <glad/gl.h>

#include <cstring>
#include <stdexcept>

#include "platform/kinds.h"

namespace platform {
namespace {

const GLubyte* GLAD_API_PTR version_for_glad(GLenum) {
  return reinterpret_cast<const GLubyte*>("4.6");
}
// By default, glad reads the list of extensions with glGetStringi, which OpenGL ES 2.0 does not have. If the
// version is 2.1, glad reads the list with glGetString.
const GLubyte* GLAD_API_PTR old_version_for_glad(GLenum) {
  return reinterpret_cast<const GLubyte*>("2.1");
}

}  // namespace

Context::Context(int width, int height, bool has_framebuffer)
    : width_(width), height_(height), has_framebuffer_(has_framebuffer) {}

Context::~Context() = default;

void Context::size(int* width, int* height) const {
  *width = width_;
  *height = height_;
}

void* Context::loader(void* user, const char* name) {
  return static_cast<Context*>(user)->proc(name);
}

void Context::load_functions() {
  gl_ = std::make_unique<GladGLContext>();
  // glad only loads the functions of the OpenGL version in GL_VERSION, but OpenGL ES has other version
  // numbers. The functions of OpenGL ES have the same names and meanings as in OpenGL. So this code makes
  // glad load every function that the driver has.
  const GLADuserptrloadfunc load = [](void* user, const char* name) {
    if (std::strcmp(name, "glGetString") == 0 && static_cast<Context*>(user)->is_es()) {
      const auto get_string = reinterpret_cast<PFNGLGETSTRINGPROC>(loader(user, name));
      const auto* const version = reinterpret_cast<const char*>(get_string(GL_VERSION));
      const bool old = version && std::strstr(version, "OpenGL ES 2.");
      return reinterpret_cast<GLADapiproc>(old ? &old_version_for_glad : &version_for_glad);
    }
    return reinterpret_cast<GLADapiproc>(loader(user, name));
  };
  if (!gladLoadGLContextUserPtr(gl_.get(), load, this))
    throw std::runtime_error("create_context: the OpenGL functions could not be loaded; check the driver");
  gl_->GetString = reinterpret_cast<decltype(gl_->GetString)>(proc("glGetString"));
}

unsigned Context::framebuffer() {
  if (has_framebuffer_) {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, 0);
    return 0;
  }
  if (framebuffer_ == 0) {
    gl_->GenFramebuffers(1, &framebuffer_);
    gl_->GenRenderbuffers(2, renderbuffers_);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    const GLenum formats[2] = {GL_RGBA8, GL_DEPTH_COMPONENT24};
    const GLenum attachments[2] = {GL_COLOR_ATTACHMENT0, GL_DEPTH_ATTACHMENT};
    for (int i = 0; i < 2; ++i) {
      gl_->BindRenderbuffer(GL_RENDERBUFFER, renderbuffers_[i]);
      gl_->RenderbufferStorage(GL_RENDERBUFFER, formats[i], width_, height_);
      gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, attachments[i], GL_RENDERBUFFER, renderbuffers_[i]);
    }
    gl_->BindRenderbuffer(GL_RENDERBUFFER, 0);
    if (gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error(
          "Context::framebuffer: this OpenGL cannot draw into an RGBA8 framebuffer with a 24-bit depth "
          "buffer; use another driver");
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  return framebuffer_;
}

std::string Context::version() const {
  return reinterpret_cast<const char*>(gl_->GetString(GL_VERSION));
}
std::string Context::renderer() const {
  return reinterpret_cast<const char*>(gl_->GetString(GL_RENDERER));
}

const char* context_kinds() {
#ifdef PLATFORM_HAS_OSMESA
  return "egl, osmesa, window";
#else
  return "egl, window";
#endif
}

std::unique_ptr<Context> create_context(const ContextRequest& request) {
  if (request.es && request.kind != "egl")
    throw std::runtime_error("create_context: OpenGL ES contexts need the kind egl (got " + request.kind +
                             ")");
  if (request.kind == "egl") return create_egl_context(request);
  if (request.kind == "window") return create_window_context(request);
#ifdef PLATFORM_HAS_OSMESA
  if (request.kind == "osmesa") return create_osmesa_context(request);
#endif
  throw std::runtime_error("create_context: unknown kind of context '" + request.kind +
                           "'; this build knows " + context_kinds());
}

}  // namespace platform
