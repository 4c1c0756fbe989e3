// Creates contexts with OSMesa, which renders in software into memory of this process.
#include <GL/osmesa.h>

#include <stdexcept>

#include "platform/kinds.h"

namespace platform {
namespace {

class OsmesaContext final : public Context {
 public:
  OsmesaContext(const ContextRequest& request, OSMesaContext context)
      : Context(request.width, request.height, true),
        context_(context),
        pixels_(static_cast<std::size_t>(request.width) * request.height * 4) {
    make_current();
    load_functions();
  }
  ~OsmesaContext() override {
    if (OSMesaGetCurrentContext() == context_) clear_current();
    OSMesaDestroyContext(context_);
  }
  void make_current() override {
    if (!OSMesaMakeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width_, height_))
      throw std::runtime_error("Context::make_current: OSMesaMakeCurrent failed; check the size");
  }
  void clear_current() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
  void* proc(const char* name) const override { return reinterpret_cast<void*>(OSMesaGetProcAddress(name)); }

 private:
  OSMesaContext context_;
  std::vector<std::uint8_t> pixels_;
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(const ContextRequest& request) {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            24,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            request.major,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            request.minor,
                            0};
  const OSMesaContext context = OSMesaCreateContextAttribs(attributes, nullptr);
  if (!context)
    throw std::runtime_error("create_context: OSMesa cannot create an OpenGL " +
                             std::to_string(request.major) + "." + std::to_string(request.minor) +
                             " core context; request a lower version");
  return std::make_unique<OsmesaContext>(request, context);
}

}  // namespace platform
