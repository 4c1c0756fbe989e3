// C++17 wrappers of materials: nook_material.h.
#ifndef NOOK_MATERIAL_HPP
#define NOOK_MATERIAL_HPP

#include <cstddef>
#include <cstdint>

#include "nook_handle.hpp"
#include "nook_material.h"

namespace nook {
inline namespace wrapper {

inline nook_material_desc material_desc() {
  nook_material_desc desc;
  check(nook_material_desc_init(&desc));
  return desc;
}

class Material : public Unique<nook_material, nook_material_destroy> {
 public:
  Material(const Context& context, const void* bytes, std::size_t size,
           const nook_material_desc& desc = material_desc())
      : Unique(load(context, bytes, size, desc)) {}

  nook_material_info info() const {
    nook_material_info info{};
    info.struct_size = sizeof info;
    check(nook_material_describe(get(), &info));
    return info;
  }
  void evaluate(const nook_material_pixel* pixels, std::uint32_t count, std::uint32_t fetches,
                nook_material_value* values) const {
    check(nook_material_evaluate(get(), pixels, count, fetches, values));
  }

 private:
  static nook_material load(const Context& context, const void* bytes, std::size_t size,
                            const nook_material_desc& desc) {
    nook_material handle = nullptr;
    check(nook_material_load(context.get(), bytes, size, &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
