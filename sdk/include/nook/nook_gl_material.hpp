// C++17 wrappers of materials in OpenGL: nook_gl_material.h.
#ifndef NOOK_GL_MATERIAL_HPP
#define NOOK_GL_MATERIAL_HPP

#include <cstdint>
#include <vector>

#include "nook_gl.hpp"
#include "nook_gl_material.h"
#include "nook_material.hpp"

namespace nook {
inline namespace wrapper {

inline nook_gl_material_desc gl_material_desc() {
  nook_gl_material_desc desc;
  check(nook_gl_material_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// Every function and the destructor belong to the context thread, as for Gl.
class GlMaterial : public Unique<nook_gl_material, nook_gl_material_destroy> {
 public:
  GlMaterial() = default;
  GlMaterial(const Gl& gl, const Material& material, const nook_gl_material_desc& desc = gl_material_desc())
      : Unique(create(gl, material, desc)) {}

  nook_gl_material_info info() const {
    nook_gl_material_info info{};
    info.struct_size = sizeof info;
    check(nook_gl_material_describe(get(), &info));
    return info;
  }
  std::vector<nook_gl_material_texture> textures() const {
    std::vector<nook_gl_material_texture> all(info().texture_count);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
      all[i].struct_size = sizeof all[i];
      check(nook_gl_material_describe_texture(get(), i, &all[i]));
    }
    return all;
  }

 private:
  static nook_gl_material create(const Gl& gl, const Material& material, const nook_gl_material_desc& desc) {
    nook_gl_material handle = nullptr;
    check(nook_gl_material_create(gl.get(), material.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
