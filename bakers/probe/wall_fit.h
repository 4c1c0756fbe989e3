// Walls of a grid's cells, learned: the planes and masks (sdk/src/probe/probe.h) whose interpolation has the
// smallest error of irradiance at places where it was path traced, instead of planes and masks from distances
// or visibility: what counts is whose light is right there.
#pragma once

#include "bakers/probe/training_places.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Metres along the normal, by which places are looked up: a fiftieth of the shortest spacing.
float wall_bias(const nook::probe::Grid& grid);

// probes: of harmonics, with coefficients; their walls are not read. The same result on any number of
// threads.
nook::probe::GridWalls fit_walls(const nook::probe::Probes& probes, const TrainingPlaces& places);

}  // namespace nook::bake::probe
