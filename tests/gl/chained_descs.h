// Descriptors of the passes over the screen with their debug descriptors. Each stays chained to its own debug
// descriptor, also in copies.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <nook/nook_nnao.h>
#include <nook/nook_world.h>

#include <cstdlib>

namespace nook::test {

inline void init(nook_result result) {
  if (result != NOOK_OK) std::abort();
}
inline void init(nook_nnao_desc& desc) {
  init(nook_nnao_desc_init(&desc));
}
inline void init(nook_nnao_debug_desc& desc) {
  init(nook_nnao_debug_desc_init(&desc));
}
inline void init(nook_nnao_frame_desc& desc) {
  init(nook_nnao_frame_desc_init(&desc));
}
inline void init(nook_nnao_frame_debug_desc& desc) {
  init(nook_nnao_frame_debug_desc_init(&desc));
}
inline void init(nook_world_frame_desc& desc) {
  init(nook_world_frame_desc_init(&desc));
}
inline void init(nook_world_frame_debug_desc& desc) {
  init(nook_world_frame_debug_desc_init(&desc));
}

template <class Desc, class Debug>
struct Chained : Desc {
  Chained() {
    init(static_cast<Desc&>(*this));
    init(debug);
    this->next = &debug;
  }
  Chained(const Chained& other) : Desc(other), debug(other.debug) { this->next = &debug; }
  Chained& operator=(const Chained& other) {
    Desc::operator=(other);
    debug = other.debug;
    this->next = &debug;
    return *this;
  }

  Debug debug;
};

using PassDesc = Chained<nook_nnao_desc, nook_nnao_debug_desc>;

// Both descriptors of a frame of the screen pass.
struct ScreenFrame : nook_gl_frame_desc, Chained<nook_nnao_frame_desc, nook_nnao_frame_debug_desc> {
  ScreenFrame() : nook_gl_frame_desc() { init(nook_gl_frame_desc_init(this)); }
};

// Both descriptors of a frame of the world pass.
struct DarkenedFrame : nook_gl_frame_desc, Chained<nook_world_frame_desc, nook_world_frame_debug_desc> {
  explicit DarkenedFrame(const nook_gl_frame_desc& frame) : nook_gl_frame_desc(frame) {}
};

}  // namespace nook::test
