// Clips for many instances at once. The CPU only stores the time, the place and a bound of each instance,
// which takes constant time per instance. The bones are decoded where they are needed: by a shader in an
// update on the GPU (shaders/character/clip_bones.comp), or by decode_late_bones on the CPU.
#pragma once

#include <nook/experimental/nook_clip_crowds.h>

#include <algorithm>
#include <span>

#include "sdk/src/character/scene.h"

namespace nook {

// Sets the clip, time and place of several different instances. If one of them is invalid, throws Failure and
// sets none. Does not allocate.
void set_clips(Scene& scene, const Ref<const LoadedClips>& clips, std::span<const nook_instance_clip> given);

// Decodes the bones of an instance whose clip came from set_clips, unless they were decoded already.
void decode_late_bones(Instance& instance) noexcept;

// Returns one bone without decoding the others.
Mat3x4 bone_of(const Instance& instance, std::size_t bone) noexcept;

// Records that no bone of the current pose was projected.
inline void forget_uneven(Instance& instance) noexcept {
  if (instance.parts) std::fill(instance.parts->uneven.begin(), instance.parts->uneven.end(), false);
}

// Ends the clip. From now on, the host sets the pose of the instance.
inline void leave_clip(Instance& instance) noexcept {
  instance.input.clip.clips = {};
  instance.input.clip.is_late = false;
}

}  // namespace nook
