// nook evaluate world --light: what a character takes of the light of a map from a floor and a wall, channel
// by channel, against path tracing.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/split_light.h"
#include "bakers/measure/world/world_report.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// One row for each map, surface and method: "none" (the light as if no body stood in it), "ao_x_probe" and
// "per_lobe". In both of the latter the map's brightest sun is a cone of light, and the rest 32 lobes. The
// casters are those of the model; study.rays are paths for a point. Throws Failure (INVALID_ARGUMENT: the
// model has no world casters; CANCELLED).
nlohmann::ordered_json world_light_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                        std::span<const bake::Pose> poses, std::span<const NamedMap> maps,
                                        const WorldStudy& study, const WorldProgress& progress);

}  // namespace nook::measure
