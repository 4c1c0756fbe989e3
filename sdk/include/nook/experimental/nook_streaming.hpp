// C++17 wrapper of streaming: nook_streaming.h. The functions belong to the context thread.
#ifndef NOOK_STREAMING_HPP
#define NOOK_STREAMING_HPP

#include <cstdint>

#include "../nook_gl.hpp"
#include "nook_streaming.h"

namespace nook {
inline namespace wrapper {

// Puts a scene into streaming mode; struct_size is set here.
inline void set_streaming(const Gl& gl, Scene& scene, nook_gl_stream_desc desc) {
  desc.struct_size = sizeof desc;
  check(nook_gl_scene_set_streaming(gl.get(), scene.get(), &desc));
}

// Uploads for `budget_us` microseconds, and returns what is left to do.
inline nook_gl_stream_info prepare_within(const Gl& gl, Scene& scene, std::uint32_t budget_us) {
  nook_gl_stream_info info{};
  info.struct_size = sizeof info;
  check(nook_gl_scene_prepare_within(gl.get(), scene.get(), budget_us, &info));
  return info;
}

}  // namespace wrapper
}  // namespace nook
#endif
