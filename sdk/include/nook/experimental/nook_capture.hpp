// C++17 wrappers of captures: nook_capture.h.
#ifndef NOOK_CAPTURE_HPP
#define NOOK_CAPTURE_HPP

#include <cstdint>

#include "../nook_gl.hpp"
#include "../nook_probe.hpp"
#include "nook_capture.h"

namespace nook {
inline namespace wrapper {

// Computes probes from cube maps that you render, and writes them into one or two Uploads. Call every
// function and the destructor on the context thread, as nook_capture.h documents.
class GlProbeCapture : public Unique<nook_gl_capture, nook_gl_capture_destroy> {
 public:
  // Returns the defaults. Change the fields as you need.
  static nook_gl_capture_desc defaults() {
    nook_gl_capture_desc desc;
    check(nook_gl_capture_desc_init(&desc));
    return desc;
  }
  GlProbeCapture(const Gl& gl, const nook_gl_capture_desc& desc) : Unique(create(gl, desc)) {}

  // Adds a cube map to the probe `index`. If `restart` is true, the average starts again with this map.
  void add(std::uint32_t index, std::uint32_t cube_map, bool restart = false) {
    check(nook_gl_capture_add(get(), index, cube_map, restart));
  }
  nook_gl_capture_info read(std::uint32_t index) const {
    nook_gl_capture_info result{};
    result.struct_size = sizeof result;
    check(nook_gl_capture_read(get(), index, &result));
    return result;
  }
  Probe solve() const {
    nook_probe handle = nullptr;
    check(nook_gl_capture_solve(get(), &handle));
    return Probe(handle);
  }

 private:
  static nook_gl_capture create(const Gl& gl, const nook_gl_capture_desc& desc) {
    nook_gl_capture handle = nullptr;
    check(nook_gl_capture_create(gl.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
