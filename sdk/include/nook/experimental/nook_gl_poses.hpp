// C++17 wrapper of poses on the GPU: nook_gl_poses.h. Call both functions on the context thread.
#ifndef NOOK_GL_POSES_HPP
#define NOOK_GL_POSES_HPP

#include <cstdint>
#include <vector>

#include "../nook_gl.hpp"
#include "nook_gl_poses.h"

namespace nook {
inline namespace wrapper {

// Sets the poses of a crowd of one model. The function sets poses.struct_size.
inline void set_poses(const Gl& gl, Scene& scene, nook_gl_poses poses,
                      const std::vector<nook_gl_instance_pose>& instances) {
  poses.struct_size = sizeof poses;
  check(nook_gl_scene_set_poses(gl.get(), scene.get(), &poses, instances.data(),
                                static_cast<std::uint32_t>(instances.size())));
}

// Returns the pose of an instance, three rows of four floats for each bone. The call waits for the GPU.
inline std::vector<float> read_pose(const Gl& gl, const Scene& scene, nook_instance_id instance,
                                    std::uint32_t bone_count) {
  std::vector<float> bones(std::size_t{12} * bone_count);
  check(nook_gl_scene_read_pose(gl.get(), scene.get(), instance, bones.data(), bone_count));
  return bones;
}

}  // namespace wrapper
}  // namespace nook
#endif
