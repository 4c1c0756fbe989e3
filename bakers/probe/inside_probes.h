// Finds and fills probes inside solids. These probes receive no light, but interpolation would read them.
#pragma once

#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Returns true if most rays from the point first hit the back of a surface. Seen from the back, the vertices
// of a triangle are clockwise. Sheets do not count as solids. Open rooms with walls that face inwards do not
// either.
bool is_inside(const LitScene& scene, Vec3 position_ws);

// Returns one value per probe. If all probes seem to be inside, the winding of the scene is not reliable, and
// all values are false.
std::vector<bool> inside_probes(const LitScene& scene, const std::vector<Vec3>& positions_ws);
std::vector<bool> inside_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Sets each inside probe to the mean of its neighbours outside (at most six). Inside probes without such
// neighbours follow, layer by layer.
void fill_inside(nook::probe::Probes& probes, const std::vector<bool>& inside);

// Positions of the probes of a grid: at the grid points, or moved out of solids and away from walls. A probe
// close to a wall would see mostly the wall.

// Moves each probe that is inside a solid, or closer to a surface than a tenth of the shortest spacing. The
// probe moves to the nearest tested position where neither is true. The tested positions are less than half a
// spacing away along each axis. If none of them is suitable, the probe stays.
std::vector<Vec3> moved_probes(const LitScene& scene, const nook::probe::Grid& grid);

// Returns the positions of the grid points.
std::vector<Vec3> grid_probes(const nook::probe::Grid& grid);

}  // namespace nook::bake::probe
