// C++17 wrappers of the stages of the screen-space pass: nook_stages.h.
#ifndef NOOK_STAGES_HPP
#define NOOK_STAGES_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../nook_clips.hpp"
#include "nook_stages.h"

namespace nook {
inline namespace wrapper {

// The stages of a screen-space pass as data, for engines without OpenGL.
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
    check(nook_nnao_stages_describe_stage(get(), index, &info));
    return info;
  }
  nook_nnao_image_info image(nook_nnao_image image) const {
    nook_nnao_image_info info{};
    info.struct_size = sizeof info;
    check(nook_nnao_stages_describe_image(get(), image, &info));
    return info;
  }
  // Pass nullptr as `earlier` after a cut.
  nook_nnao_frame_values frame(const nook_gl_frame_desc& frame, const nook_nnao_frame_desc& desc,
                               const nook_gl_frame_desc* earlier = nullptr, std::uint32_t number = 0,
                               std::uint32_t view = 0) const {
    nook_nnao_frame_values values{};
    values.struct_size = sizeof values;
    check(nook_nnao_stages_frame(get(), &frame, &desc, earlier, number, view, &values));
    return values;
  }

 private:
  static nook_nnao_stages create(const Context& context, const nook_nnao_desc& desc) {
    nook_nnao_stages handle = nullptr;
    check(nook_nnao_stages_create(context.get(), &desc, &handle));
    return handle;
  }
};

// Returns the texels of a table of clips. Rows follow each other without gaps.
inline std::vector<std::uint8_t> clips_table(const Clips& clips, nook_clips_table table, std::uint32_t& width,
                                             std::uint32_t& height) {
  std::size_t size = 0;
  check(nook_clips_read_table(clips.get(), table, nullptr, &size, &width, &height));
  std::vector<std::uint8_t> texels(size);
  check(nook_clips_read_table(clips.get(), table, texels.data(), &size, &width, &height));
  return texels;
}

}  // namespace wrapper
}  // namespace nook
#endif
