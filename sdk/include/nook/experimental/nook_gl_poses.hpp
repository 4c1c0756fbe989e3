// C++17 wrappers of poses on the GPU and of pools: nook_gl_poses.h. Call the functions on the context thread.
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

// Gives a scene a pool. The function sets desc.struct_size.
inline void set_pool(const Gl& gl, Scene& scene, nook_gl_pool_desc desc) {
  desc.struct_size = sizeof desc;
  check(nook_gl_scene_set_pool(gl.get(), scene.get(), &desc));
}

// Returns the views of instances.
inline std::vector<nook_gl_pool_view> read_pool(const Gl& gl, const Scene& scene,
                                                const std::vector<nook_instance_id>& instances) {
  std::vector<nook_gl_pool_view> views(instances.size());
  check(nook_gl_scene_read_pool(gl.get(), scene.get(), instances.data(),
                                static_cast<std::uint32_t>(instances.size()), views.data(), nullptr));
  return views;
}

// Returns how full the pool was at the last update.
inline nook_gl_pool_info pool_info(const Gl& gl, const Scene& scene) {
  nook_gl_pool_info info{};
  info.struct_size = sizeof info;
  check(nook_gl_scene_read_pool(gl.get(), scene.get(), nullptr, 0, nullptr, &info));
  return info;
}

// Returns the table of a pool on the GPU, and appends the names of the model's AO buffers to `ao_buffers`.
inline nook_gl_pool_table read_pool_table(const Gl& gl, Scene& scene, const CharacterModel& model,
                                          std::vector<std::uint32_t>& ao_buffers) {
  nook_gl_pool_table table{};
  table.struct_size = sizeof table;
  check(nook_gl_scene_read_pool_table(gl.get(), scene.get(), model.get(), &table, nullptr, 0));
  const std::size_t known = ao_buffers.size();
  ao_buffers.resize(known + table.ao_buffer_count);
  check(nook_gl_scene_read_pool_table(gl.get(), scene.get(), model.get(), &table, ao_buffers.data() + known,
                                      table.ao_buffer_count));
  return table;
}

}  // namespace wrapper
}  // namespace nook
#endif
