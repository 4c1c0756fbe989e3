// The darkening of a neighbour by a character: a lone caster at several distances, by each form and by ray
// tracing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::bake {

struct CasterRow {
  float distance_m = 0;   // between the two bodies' centres, along the ground
  const char* form = "";  // "composed" or "paper"
  double darkening =
      0;  // mean over receiver vertices by area, bearings and poses: AO alone minus AO with the caster
  double darkening_traced = 0;
  // Root mean square over vertices, by area, of what a scene's default far_error changes, by the neighbour
  // and by the body's own far spheres.
  double change_of_groups = 0;
};

struct CasterStudy {
  std::vector<float> distances_m{1, 2, 3, 5, 10};
  std::size_t bearings = 6;
  std::uint32_t rays = 256;  // a vertex; the same rays with and without the neighbour
  std::uint64_t seed = 1;
};

// poses: of the receiver, each also of the caster in turn; placed on +y-up ground. Two rows a distance.
std::vector<CasterRow> measure_casters(const SkinnedMesh& mesh, const CharacterModel& model,
                                       std::span<const Pose> poses, const CasterStudy& study,
                                       const Progress& progress = {});

}  // namespace nook::bake
