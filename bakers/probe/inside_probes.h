// Finds probes inside solids. They receive no light, but interpolation would read them.
#pragma once

#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Returns true if more than half of all directions from the point meet a surface from behind, where its
// vertices are clockwise. Sheets, and open rooms with walls that face inwards, are not solids.
bool is_inside(const LitScene& scene, Vec3 position_ws);

// Returns one answer per probe. If all probes are inside, the vertices' order says nothing, and the result is
// false for all.
std::vector<bool> inside_probes(const LitScene& scene, const std::vector<Vec3>& positions_ws);
std::vector<bool> inside_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Gives each probe inside the mean of its neighbours outside, at most six, and continues inwards from there.
void fill_inside(nook::probe::Probes& probes, const std::vector<bool>& inside);

// Places the probes of a grid at their places in the grid, or moves them out of solids and away from walls.
// Close to a wall, a probe would see mostly the wall.

// Moves each probe that is in a solid, or nearer to a surface than a tenth of the shortest spacing. It moves
// to the nearest place clear of both, less than half a spacing away along each axis. A probe without such a
// place stays.
std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Returns the places of the grid.
std::vector<Vec3> grid_probes(const nook::probe::Grid& grid);

}  // namespace nook::bake::probe
