// C++17 wrappers of coordinate textures: nook_synthesis.h.
#ifndef NOOK_SYNTHESIS_HPP
#define NOOK_SYNTHESIS_HPP

#include <cstddef>
#include <cstdint>

#include "../nook_gl.hpp"
#include "../nook_handle.hpp"
#include "nook_synthesis.h"

namespace nook {
inline namespace wrapper {

class Synthesis : public Unique<nook_synthesis, nook_synthesis_destroy> {
 public:
  Synthesis(const Context& context, const void* bytes, std::size_t size)
      : Unique(load(context, bytes, size)) {}

  nook_synthesis_info info() const {
    nook_synthesis_info info{};
    info.struct_size = sizeof info;
    check(nook_synthesis_describe(get(), &info));
    return info;
  }
  // `plane_uvs` and `material_uvs` hold two floats for each point.
  void material_uvs(const float* plane_uvs, std::uint32_t count, float* material_uvs) const {
    check(nook_synthesis_material_uvs(get(), plane_uvs, count, material_uvs));
  }

 private:
  static nook_synthesis load(const Context& context, const void* bytes, std::size_t size) {
    nook_synthesis handle = nullptr;
    check(nook_synthesis_load(context.get(), bytes, size, &handle));
    return handle;
  }
};

// Uploads a coordinate texture. Call it on the context thread.
inline Upload upload_synthesis(const Gl& gl, const Synthesis& synthesis) {
  nook_gl_upload handle = nullptr;
  check(nook_gl_upload_synthesis(gl.get(), synthesis.get(), &handle));
  return Upload(handle);
}

}  // namespace wrapper
}  // namespace nook
#endif
