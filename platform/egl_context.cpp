// Creates contexts with EGL, without a display. Tries Mesa's surfaceless platform first, then each EGL device
// until a context can be created.
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstring>
#include <stdexcept>

#include "platform/kinds.h"

namespace platform {
namespace {

template <class F>
F egl_function(const char* name) {
  return reinterpret_cast<F>(eglGetProcAddress(name));
}

bool client_has(const char* extension) {
  const char* all = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  return all && std::strstr(all, extension);
}

std::vector<EGLDisplay> displays() {
  std::vector<EGLDisplay> found;
  const auto platform_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!platform_display) return found;
  if (client_has("EGL_MESA_platform_surfaceless"))
    found.push_back(platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  if (query_devices && client_has("EGL_EXT_platform_device")) {
    EGLDeviceEXT devices[8];
    EGLint count = 0;
    if (query_devices(8, devices, &count))
      for (EGLint i = 0; i < count; ++i)
        found.push_back(platform_display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
  }
  return found;
}

EGLenum api_of(bool es) {
  return es ? EGL_OPENGL_ES_API : EGL_OPENGL_API;
}

// The EGL display is never terminated, because other code of the process may use it, too. Also, Mesa's LLVM
// leaks memory if the display is terminated.
class EglContext final : public Context {
 public:
  EglContext(const ContextRequest& request, EGLDisplay display, EGLContext context)
      : Context(request.width, request.height, false), display_(display), context_(context), es_(request.es) {
    make_current();
    load_functions();
  }
  ~EglContext() override {
    if (eglGetCurrentContext() == context_) clear_current();
    eglDestroyContext(display_, context_);
  }
  void make_current() override {
    if (!eglBindAPI(api_of(es_)) || !eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
      throw std::runtime_error(
          "Context::make_current: eglMakeCurrent failed; use a driver with EGL_KHR_surfaceless_context");
  }
  void clear_current() override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
  bool is_es() const override { return es_; }
  void* proc(const char* name) const override { return reinterpret_cast<void*>(eglGetProcAddress(name)); }

 private:
  EGLDisplay display_;
  EGLContext context_;
  bool es_;
};

// Passes the debug attribute only if it is needed, because some drivers reject it for any value.
EGLContext create(EGLDisplay display, const ContextRequest& request, bool debug) {
  std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION, request.major, EGL_CONTEXT_MINOR_VERSION,
                                    request.minor};
  // OpenGL ES has no profiles.
  if (!request.es)
    attributes.insert(attributes.end(),
                      {EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT});
  if (debug) attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_DEBUG, EGL_TRUE});
  attributes.push_back(EGL_NONE);
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

std::unique_ptr<Context> create_egl_context(const ContextRequest& request) {
  for (const EGLDisplay display : displays()) {
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
        !eglBindAPI(api_of(request.es)))
      continue;
    EGLContext context = request.debug ? create(display, request, true) : EGL_NO_CONTEXT;
    if (context == EGL_NO_CONTEXT) context = create(display, request, false);
    if (context != EGL_NO_CONTEXT) return std::make_unique<EglContext>(request, display, context);
  }
  throw std::runtime_error(std::string("create_context: no EGL display can create an OpenGL ") +
                           (request.es ? "ES " : "") + std::to_string(request.major) + "." +
                           std::to_string(request.minor) + (request.es ? "" : " core") +
                           " context; install libegl1 and libgl1-mesa-dri");
}

}  // namespace platform
