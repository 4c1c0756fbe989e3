// For `nook evaluate world`: measures how a character darkens the world. Compares Nook's casters and the
// methods that engines use with ray tracing.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/split_light.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

struct WorldStudy {
  // Points on each surface in each pose.
  std::size_t points = 1500;
  std::uint32_t rays = 512;  // per point, for AO; each cone of light uses an eighth of these rays
  std::uint32_t cone_rays() const { return rays / 8 > 0 ? rays / 8 : 1; }
  std::vector<float> cone_degrees{5, 20, 60};  // full angles of the cones of light
  std::size_t bootstrap = 400;                 // resamples of the poses
  std::uint64_t seed = 1;
  // The casters of the method "nook". If empty, uses the model's casters.
  std::vector<WorldCaster> casters;
};

using WorldProgress = std::function<bool(std::size_t done, std::size_t total)>;

// Returns one row for each surface and method. Throws Failure (INVALID_ARGUMENT: the model has no world
// casters; CANCELLED).
nlohmann::ordered_json world_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                  std::span<const bake::Pose> poses, const WorldStudy& study,
                                  const WorldProgress& progress);

// Returns one row for each map, surface and method. The methods are "none" (the light without a body),
// "ao_x_probe" and "per_lobe". In the last two, the brightest sun of the map is a cone of light, and the rest
// of the light is 32 lobes. Uses the model's casters. Traces study.rays paths per point. Throws Failure
// (INVALID_ARGUMENT: the model has no world casters; CANCELLED).
nlohmann::ordered_json world_light_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                        std::span<const bake::Pose> poses, std::span<const NamedMap> maps,
                                        const WorldStudy& study, const WorldProgress& progress);

}  // namespace nook::measure
