// Measures the AO that a renderer shows between vertices. Renderers interpolate AO over triangles, and parts
// of a triangle may be visible although its vertices are inside the body.
#pragma once

#include <cstdint>
#include <span>

#include "bakers/import/skinned_mesh.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/character/model.h"

namespace nook::measure {

// Mean squared errors of interpolated AO over points whose ray-traced AO is at least visible_truth.
struct SurfaceErrors {
  double model = 0;
  double static_bake = 0;
  double exact_vertices = 0;  // with the vertices' own traced AO
  double visible_share = 0;   // share of the points of all poses that are visible
};

// Traces 2,048 points in at most 24 of the poses, with 256 rays for each point. The points are spread evenly
// over the area of the rest pose. The same seed gives the same errors on any number of threads. All errors
// are 0 if no point is visible. Throws Failure(NOOK_ERROR_CANCELLED) if progress returns false.
SurfaceErrors measure_surface(const bake::SkinnedMesh& mesh, const CharacterModel& model,
                              std::span<const bake::Pose> poses, std::uint64_t seed,
                              const bake::Progress& progress = {});

}  // namespace nook::measure
