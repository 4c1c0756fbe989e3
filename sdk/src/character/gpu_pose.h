// Poses that stay on the GPU. The CPU knows only where the body is and how large its bones are, which
// culling, the ground, neighbours and levels of detail need. Everything that reads bones on the CPU must
// refuse such an instance, because its bones there are of an earlier pose.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook {

// What the host tells about a pose on the GPU.
struct GpuPose {
  Sphere bound;             // holds all key points and proxy spheres; world space
  float largest_scale = 1;  // of the bones
};

// A bit of InstanceInput::reported, beside the topics of PoseNotes. It says that the log has told that the
// instance does not darken the world.
inline constexpr std::uint32_t topic_no_world_casters = 8;

// The instance has its pose on the GPU from now on. A clip ends, as with set_pose.
void take_gpu_pose(Scene& scene, Instance& instance, const GpuPose& pose) noexcept;

// The instance has its pose on the CPU from now on. Call it when the bones are set.
void leave_gpu_pose(Scene& scene, Instance& instance) noexcept;

// Throws Failure(NOOK_ERROR_UNSUPPORTED) if the pose of the instance is on the GPU.
void need_cpu_pose(const Instance& instance);
// The same for all instances of the scene.
void need_cpu_poses(const Scene& scene);

}  // namespace nook
