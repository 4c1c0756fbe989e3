// C++17 wrappers of the screen-space pass: nook_nnao.h.
#ifndef NOOK_NNAO_HPP
#define NOOK_NNAO_HPP

#include <cstdint>

#include "experimental/nook_recording.hpp"
#include "experimental/nook_stages.h"
#include "nook_gl.hpp"
#include "nook_nnao.h"

namespace nook {
inline namespace wrapper {

// You must set max_width and max_height.
inline nook_nnao_desc nnao_desc(nook_nnao_preset preset = NOOK_NNAO_PRESET_DEFAULT) {
  nook_nnao_desc desc;
  check(nook_nnao_desc_init(&desc));
  desc.preset = preset;
  return desc;
}

// You must set the radius.
inline nook_nnao_frame_desc nnao_frame_desc() {
  nook_nnao_frame_desc desc;
  check(nook_nnao_frame_desc_init(&desc));
  return desc;
}

// Returns the texture memory of a pass with this descriptor, in bytes.
inline std::uint64_t nnao_memory(const nook_nnao_desc& desc) {
  std::uint64_t bytes = 0;
  check(nook_nnao_memory(&desc, &bytes));
  return bytes;
}

// Call every function and the destructor on the context thread, as nook_nnao.h documents.
class Nnao : public Unique<nook_nnao, nook_nnao_destroy> {
 public:
  Nnao() = default;
  Nnao(const Gl& gl, const nook_nnao_desc& desc) : Unique(create(gl, desc)) {}

  void render(const nook_gl_frame_desc& frame, const nook_nnao_frame_desc& desc) {
    check(nook_nnao_render(get(), &frame, &desc));
  }
  Recording record(const nook_gl_frame_desc& frame, const nook_nnao_frame_desc& desc,
                   const char* note = nullptr) {
    nook_nnao_recording handle = nullptr;
    check(nook_nnao_record(get(), &frame, &desc, note, &handle));
    return Recording(handle);
  }
  nook_nnao_info info() const {
    nook_nnao_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_describe(get(), &info));
    return info;
  }
  nook_nnao_timings timings() const {
    nook_nnao_timings timings{};
    timings.struct_size = sizeof timings;
    check(nook_nnao_read_timings(get(), &timings));
    return timings;
  }

 private:
  static nook_nnao create(const Gl& gl, const nook_nnao_desc& desc) {
    nook_nnao handle = nullptr;
    check(nook_nnao_create(gl.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
