// Finds and fills probes inside solids. These probes receive no light, but interpolation would read them.
#pragma once

#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Returns true if, in more than half of all directions, a ray from the point hits the back of a surface. The
// vertices of a triangle are clockwise when seen from the back. Sheets do not count as solids, nor do open
// rooms with walls that face inwards.
bool is_inside(const LitScene& scene, Vec3 position_ws);

// Returns one result per probe. If all probes are inside, the winding of the scene is not reliable, and all
// results are false.
std::vector<bool> inside_probes(const LitScene& scene, const std::vector<Vec3>& positions_ws);
std::vector<bool> inside_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Sets each inside probe to the mean of its neighbours outside (at most six). Probes without such neighbours
// follow afterwards, layer by layer.
void fill_inside(nook::probe::Probes& probes, const std::vector<bool>& inside);

// Positions of the probes of a grid: at the grid points, or moved out of solids and away from walls. A probe
// close to a wall would see mostly the wall.

// Moves each probe that is inside a solid, or closer to a surface than a tenth of the shortest spacing. The
// probe moves to the nearest position that is neither, less than half a spacing away along each axis. If
// there is no such position, the probe is not moved.
std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Returns the positions of the grid points.
std::vector<Vec3> grid_probes(const nook::probe::Grid& grid);

}  // namespace nook::bake::probe
