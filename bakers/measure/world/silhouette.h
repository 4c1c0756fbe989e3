// Compares outlines of shadows on the floor, under a light of one degree, with ray tracing.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "bakers/measure/world/world_report.h"

namespace nook::measure {

// Returns one row for each method that has a shape of its own: nook and capsules. iou is the area that both
// shadows cover over the area that one of them covers, as a mean over all shadows of the best variant;
// iou_low is the worst shadow. Throws Failure (INVALID_ARGUMENT: the model has no world casters; CANCELLED).
nlohmann::ordered_json silhouette_rows(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const bake::Pose> poses, const WorldStudy& study,
                                       const WorldProgress& progress);

}  // namespace nook::measure
