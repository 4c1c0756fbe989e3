// Poses that stay on the GPU. The CPU only knows the bounding sphere of the body and the scale of its bones.
// This is enough for culling, the ground, neighbours and levels of detail. All code that reads bones on the
// CPU must refuse such an instance, because the bones on the CPU are from an earlier pose.
#pragma once

#include "sdk/src/character/scene.h"

namespace nook {

// What the host must pass to describe a pose that is on the GPU.
struct GpuPose {
  Sphere bound;             // contains all key points and proxy spheres; world space
  float largest_scale = 1;  // largest scale of the bones
};

// A bit of InstanceInput::reported, in addition to the topics of PoseNotes. It is set after the log has
// reported that the instance does not darken the world.
inline constexpr std::uint32_t topic_no_world_casters = 8;

// From now on, the pose of the instance is on the GPU. If the instance plays a clip, the call ends the clip,
// as set_pose does.
void take_gpu_pose(Scene& scene, Instance& instance, const GpuPose& pose) noexcept;

// From now on, the pose of the instance is on the CPU. Call it when the bones are set.
void leave_gpu_pose(Scene& scene, Instance& instance) noexcept;

// Throws Failure(NOOK_ERROR_UNSUPPORTED) if the pose of the instance is on the GPU, or if it has no bones
// because its scene has a pool.
void need_cpu_pose(const Instance& instance);
// Throws Failure(NOOK_ERROR_UNSUPPORTED) if the scene has a pool, or the pose of any instance is on the GPU.
void need_cpu_poses(const Scene& scene);

}  // namespace nook
