// C++17 wrappers of coordinate textures in OpenGL: nook_gl_synthesis.h.
#ifndef NOOK_GL_SYNTHESIS_HPP
#define NOOK_GL_SYNTHESIS_HPP

#include "nook_gl.hpp"
#include "nook_gl_synthesis.h"
#include "nook_synthesis.hpp"

namespace nook {
inline namespace wrapper {

// Every function and the destructor belong to the context thread, as for Gl.
class GlSynthesis : public Unique<nook_gl_synthesis, nook_gl_synthesis_destroy> {
 public:
  GlSynthesis() = default;
  GlSynthesis(const Gl& gl, const Synthesis& synthesis) : Unique(create(gl, synthesis)) {}

  nook_gl_synthesis_info info() const {
    nook_gl_synthesis_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_synthesis_describe(get(), &info));
    return info;
  }

 private:
  static nook_gl_synthesis create(const Gl& gl, const Synthesis& synthesis) {
    nook_gl_synthesis handle = nullptr;
    check(nook_gl_synthesis_create(gl.get(), synthesis.get(), &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
