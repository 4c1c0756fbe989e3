// C++17 wrappers of the world pass: nook_gl_world.h.
#ifndef NOOK_GL_WORLD_HPP
#define NOOK_GL_WORLD_HPP

#include "nook_gl.hpp"
#include "nook_gl_world.h"

namespace nook {
inline namespace wrapper {

// The caller sets max_width and max_height.
inline nook_world_pass_desc world_pass_desc() {
  nook_world_pass_desc desc;
  check(nook_world_pass_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// The caller sets the screen, the view and what casts.
inline nook_world_frame_desc world_frame_desc() {
  nook_world_frame_desc desc;
  check(nook_world_frame_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// Every function and the destructor belong to the context thread, as nook_gl_world.h documents.
class WorldPass : public Unique<nook_world_pass, nook_world_pass_destroy> {
 public:
  WorldPass() = default;
  WorldPass(const Gl& gl, const nook_world_pass_desc& desc) : Unique(create(gl, desc)) {}

  void render(const nook_world_frame_desc& frame) { check(nook_world_render(get(), &frame)); }
  void recheck() { check(nook_world_recheck(get())); }
  nook_world_pass_info info() const {
    nook_world_pass_info info{};
    info.struct_size = sizeof info;
    check(nook_world_pass_describe(get(), &info));
    return info;
  }

 private:
  static nook_world_pass create(const Gl& gl, const nook_world_pass_desc& desc) {
    nook_world_pass handle = nullptr;
    check(nook_world_pass_create(gl.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
