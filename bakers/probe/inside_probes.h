// Probes of a grid that stand inside solids, where no light is and none is looked up, but from where the
// interpolation would take it.
#pragma once

#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// More than half of all directions from the point meet a surface from behind, where its vertices go round
// clockwise. Sheets and open rooms with walls that face inwards are no solids.
bool is_inside(const LitScene& scene, Vec3 position_ws);

// One answer a probe. Where all of them are inside, the vertices' order says nothing, and none is.
std::vector<bool> inside_probes(const LitScene& scene, const std::vector<Vec3>& positions_ws);
std::vector<bool> inside_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Gives each probe inside the mean of its neighbours outside, six at most, and so on from there inwards.
void fill_inside(nook::probe::Probes& probes, std::vector<bool> inside);

// Where the probes of a grid stand: at their places in the grid, or moved out of solids and away from walls,
// where most of what they would see is the wall itself.

// Moves a probe that stands in a solid, or nearer to a surface than a tenth of the shortest spacing, to the
// nearest place that is clear of both, less than half of a spacing away along each axis. A probe without such
// a place stays.
std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Those of the grid.
std::vector<Vec3> grid_probes(const nook::probe::Grid& grid);

}  // namespace nook::bake::probe
