// Compares the outlines of shadows on the floor with ray-traced shadows, under a light with an angular
// diameter of one degree.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "bakers/measure/world/world_report.h"

namespace nook::measure {

// Returns one row for each method whose shadows have an outline: nook and capsules. `iou` is the intersection
// over union of the shadow and the traced shadow, averaged over all shadows, for the method's best variant.
// `iou_low` is the lowest value of any shadow. Throws Failure (INVALID_ARGUMENT: the model has no world
// casters; CANCELLED).
nlohmann::ordered_json silhouette_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, const WorldStudy& study,
                                       const WorldProgress& progress);

}  // namespace nook::measure
