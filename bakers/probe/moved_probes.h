// Where the probes of a grid stand: at their places in the grid, or moved out of solids and away from walls,
// where most of what they would see is the wall itself.
#pragma once

#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Moves a probe that stands in a solid, or nearer to a surface than a tenth of the shortest spacing, to the
// nearest place that is clear of both, less than half of a spacing away along each axis. A probe without such
// a place stays.
std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Those of the grid.
std::vector<Vec3> grid_probes(const nook::probe::Grid& grid);

}  // namespace nook::bake::probe
