// C++17 wrapper of nook_clip_crowds.h, which plays clips on a crowd.
#ifndef NOOK_CLIP_CROWDS_HPP
#define NOOK_CLIP_CROWDS_HPP

#include <cstdint>
#include <vector>

#include "../nook_clips.hpp"
#include "nook_clip_crowds.h"

namespace nook {
inline namespace wrapper {

// Sets clip, time and place of a crowd.
inline void set_clips(Scene& scene, const Clips& clips, const std::vector<nook_instance_clip>& instances) {
  check(nook_scene_set_clips(scene.get(), clips.get(), instances.data(),
                             static_cast<std::uint32_t>(instances.size())));
}

}  // namespace wrapper
}  // namespace nook
#endif
