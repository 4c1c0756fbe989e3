#include "sdk/src/character/memory_use.h"

#include "sdk/src/character/light.h"
#include "sdk/src/character/scene.h"

namespace nook {

std::uint64_t instance_bytes(const LoadedModel& model) {
  std::uint64_t words = sphere_lanes * padded_count(model.model.spheres.size()) +
                        (point_lanes + code_lanes) * model.rest_key_points.padded_count();
  for (const LoadedLevel& level : model.levels)
    words += sphere_lanes * padded_count(level.rest_spheres.view().count);
  for (std::uint32_t t = 0; t < group_tiers; ++t)
    words += group_lanes * padded_count(model.groups.tier(t).count());
  return sizeof(Instance) + words * sizeof(float) + model.model.bone_count() * sizeof(Mat3x4) +
         model.model.world_casters.size() * sizeof(PosedCaster);
}

std::uint64_t light_bytes(const LoadedModel& model) {
  return light_lanes * model.rest_key_points.padded_count() * sizeof(float) +
         max_light_lobes * (sizeof(LightLobe) + sizeof(LobeBands));
}

}  // namespace nook
