#include "sdk/src/character/gpu_pose.h"

#include <algorithm>

#include "sdk/src/character/scene_clips.h"
#include "sdk/src/character/scene_pool.h"
#include "sdk/src/core/failure.h"

namespace nook {

void take_gpu_pose(Scene& scene, Instance& instance, const GpuPose& pose) noexcept {
  InstanceInput& input = instance.input;
  if (!input.is_posed_on_gpu) {
    input.is_posed_on_gpu = true;
    ++scene.posed_on_gpu;
    forget_uneven(instance);
    leave_clip(instance);
  }
  input.bound = pose.bound;
  input.scale = pose.largest_scale * InstanceInput::scale_margin;
  ++input.pose_revision;
}

void leave_gpu_pose(Scene& scene, Instance& instance) noexcept {
  if (!instance.input.is_posed_on_gpu) return;
  instance.input.is_posed_on_gpu = false;
  --scene.posed_on_gpu;
}

void need_cpu_pose(const Instance& instance) {
  if (instance.input.is_posed_on_gpu)
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "the pose of instance %u is on the GPU, and this call needs it on the CPU; first set all "
                  "bones with nook_scene_set_pose, or set a clip",
                  instance.id);
  if (instance.bones().empty())
    throw Failure(NOOK_ERROR_UNSUPPORTED,
                  "instance %u belongs to a scene with a pool and has no bones on the CPU, which this call "
                  "needs; first call nook_scene_set_pose or nook_scene_set_clip",
                  instance.id);
}

void need_cpu_poses(const Scene& scene) {
  need_no_pool(scene, "this call needs the bones of all instances on the CPU; use a scene without a pool");
  if (scene.posed_on_gpu == 0) return;
  for (const Instance& instance : scene.instances)
    if (instance.id) need_cpu_pose(instance);
}

}  // namespace nook
