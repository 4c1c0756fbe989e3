// C++17 wrappers of baked clips: nook_clips.h.
#ifndef NOOK_CLIPS_HPP
#define NOOK_CLIPS_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "nook_character.hpp"
#include "nook_clips.h"

namespace nook {
inline namespace wrapper {

class Clips : public Unique<nook_clips, nook_clips_destroy> {
 public:
  Clips(const Context& context, const CharacterModel& model, const void* bytes, std::size_t size)
      : Unique(load(context, model, bytes, size)) {}

  nook_clips_info info() const {
    nook_clips_info info{};
    info.struct_size = sizeof info;
    check(nook_clips_describe(get(), &info));
    return info;
  }
  nook_clip_info clip(std::uint32_t index) const {
    nook_clip_info info{};
    info.struct_size = sizeof info;
    check(nook_clips_clip(get(), index, &info));
    return info;
  }
  std::uint32_t find(const char* name) const {
    std::uint32_t index = 0;
    check(nook_clips_find(get(), name, &index));
    return index;
  }
  // The AO of the character alone, in the order of Scene::ao.
  std::vector<float> ao(const nook_clip_time& time) const {
    std::vector<float> values(info().file_vertex_count);
    check(nook_clips_read_ao(get(), &time, NOOK_AO_FLOAT, values.data(),
                             static_cast<std::uint32_t>(values.size()), 0));
    return values;
  }
  std::vector<std::uint8_t> texture(nook_clips_table table, std::uint32_t& width,
                                    std::uint32_t& height) const {
    std::uint64_t bytes = 0;
    check(nook_clips_texture_size(get(), table, &width, &height, &bytes));
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(bytes));
    check(nook_clips_read_texture(get(), table, texels.data(), bytes));
    return texels;
  }

 private:
  static nook_clips load(const Context& context, const CharacterModel& model, const void* bytes,
                         std::size_t size) {
    nook_clips handle = nullptr;
    check(nook_clips_load(context.get(), model.get(), bytes, size, &handle));
    return handle;
  }
};

}  // namespace wrapper
}  // namespace nook
#endif
