// C++17 wrappers of baked clips: nook_clips.h.
#ifndef NOOK_CLIPS_HPP
#define NOOK_CLIPS_HPP

#include <cstddef>
#include <cstdint>
#include <string_view>
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
    check(nook_clips_describe_clip(get(), index, &info));
    return info;
  }
  // Returns the index of a clip, or the number of clips if none has this name.
  std::uint32_t find(std::string_view name) const {
    const std::uint32_t count = info().clip_count;
    std::uint32_t index = 0;
    while (index < count && clip(index).name != name) ++index;
    return index;
  }
  // Returns the AO of the character alone, in the vertex order of Scene::read.
  std::vector<float> ao(const nook_clip_time& time) const {
    std::vector<float> values(info().file_vertex_count);
    check(nook_clips_read_ao(get(), &time, NOOK_FORMAT_FLOAT, values.data(),
                             static_cast<std::uint32_t>(values.size()), 0));
    return values;
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
