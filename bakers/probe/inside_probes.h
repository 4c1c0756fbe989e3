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

}  // namespace nook::bake::probe
