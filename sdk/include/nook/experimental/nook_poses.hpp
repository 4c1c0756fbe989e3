// C++17 wrapper for the AO of many poses: nook_poses.h.
#ifndef NOOK_POSES_HPP
#define NOOK_POSES_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../nook_character.hpp"
#include "nook_poses.h"

namespace nook {
inline namespace wrapper {

// Returns the AO of all vertices in the first pose, then in the second pose, and so on. Initialise `first`
// with pose_desc(), and `settings` with scene_desc().
inline std::vector<float> evaluate_poses(const CharacterModel& model, const nook_pose_desc& first,
                                         std::uint32_t pose_count, std::size_t pose_stride = 0,
                                         const float* plane_xyzd = nullptr,
                                         const nook_scene_desc& settings = scene_desc()) {
  std::vector<float> ao(std::size_t{pose_count} * model.info().file_vertex_count);
  check(nook_model_evaluate_poses(model.get(), &settings, &first, pose_count, pose_stride, plane_xyzd,
                                  ao.data(), ao.size()));
  return ao;
}

}  // namespace wrapper
}  // namespace nook
#endif
