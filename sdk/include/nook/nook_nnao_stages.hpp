// C++17 wrappers of the stages of the screen-space pass: nook_nnao_stages.h.
#ifndef NOOK_NNAO_STAGES_HPP
#define NOOK_NNAO_STAGES_HPP

#include <cstdint>

#include "nook_handle.hpp"
#include "nook_nnao_stages.h"

namespace nook {
inline namespace wrapper {

// The stages of a screen-space pass as data, for hosts without OpenGL.
class NnaoStages : public Unique<nook_nnao_stages, nook_nnao_stages_destroy> {
 public:
  NnaoStages() = default;
  NnaoStages(const Context& context, const nook_nnao_desc& desc) : Unique(create(context, desc)) {}

  nook_nnao_stages_info info() const {
    nook_nnao_stages_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_describe(get(), &info));
    return info;
  }
  nook_nnao_stage_info stage(std::uint32_t index) const {
    nook_nnao_stage_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_stage(get(), index, &info));
    return info;
  }
  nook_nnao_image_info image(nook_nnao_image image) const {
    nook_nnao_image_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_image(get(), image, &info));
    return info;
  }
  // earlier: null for a cut.
  nook_nnao_frame_values frame(const nook_nnao_frame_desc& frame,
                               const nook_nnao_frame_desc* earlier = nullptr, std::uint32_t number = 0,
                               std::uint32_t layer = 0) const {
    nook_nnao_frame_values values{};
    values.struct_size = sizeof values;
    check(nook_nnao_stages_frame(get(), &frame, earlier, number, layer, &values));
    return values;
  }

 private:
  static nook_nnao_stages create(const Context& context, const nook_nnao_desc& desc) {
    nook_nnao_stages handle = nullptr;
    check(nook_nnao_stages_create(context.get(), &desc, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
