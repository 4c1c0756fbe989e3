// Clips for many instances at once. The CPU keeps the time and the place of each instance, and a bound that
// takes constant time. Whoever needs the bones decodes them: a shader in an update on the GPU
// (shaders/character/clip_bones.comp), or decode_late_bones on the CPU.
#pragma once

#include <nook/experimental/nook_clip_crowds.h>

#include <span>

#include "sdk/src/character/scene.h"

namespace nook {

// Sets clip, time and place of different instances, all or none. Throws Failure. Does not allocate.
void set_clips(Scene& scene, const Ref<const LoadedClips>& clips, std::span<const nook_instance_clip> given);

// Decodes the bones of an instance whose clip came from set_clips, unless they were decoded already.
void decode_late_bones(Instance& instance) noexcept;

// Returns one bone without decoding the others.
Mat3x4 bone_of(const Instance& instance, std::size_t bone) noexcept;

// The host sets the pose of the instance from now on.
inline void leave_clip(Instance& instance) noexcept {
  instance.input.clip.clips = {};
  instance.input.clip.is_late = false;
}

}  // namespace nook
