// C++17 wrappers of the world pass: nook_world.h.
#ifndef NOOK_WORLD_HPP
#define NOOK_WORLD_HPP

#include "nook_gl.hpp"
#include "nook_world.h"

namespace nook {
inline namespace wrapper {

// You must set max_width and max_height.
inline nook_world_desc world_pass_desc() {
  nook_world_desc desc;
  check(nook_world_desc_init(&desc));
  return desc;
}

// You must set the casters: `scene`, `capsules` or both.
inline nook_world_frame_desc world_frame_desc() {
  nook_world_frame_desc desc;
  check(nook_world_frame_desc_init(&desc));
  return desc;
}

// Call every function and the destructor on the context thread, as nook_world.h documents.
class WorldPass : public Unique<nook_world, nook_world_destroy> {
 public:
  WorldPass() = default;
  WorldPass(const Gl& gl, const nook_world_desc& desc) : Unique(create(gl, desc)) {}

  void render(const nook_gl_frame_desc& frame, const nook_world_frame_desc& desc) {
    check(nook_world_render(get(), &frame, &desc));
  }
  nook_world_info info() const {
    nook_world_info info{};
    info.struct_size = sizeof info;
    check(nook_world_describe(get(), &info));
    return info;
  }

 private:
  static nook_world create(const Gl& gl, const nook_world_desc& desc) {
    nook_world handle = nullptr;
    check(nook_world_create(gl.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
