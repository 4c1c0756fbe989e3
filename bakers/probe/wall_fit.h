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

// Coefficients of a grid, fitted so that what is interpolated between its probes has the smallest error at
// places where irradiance was path traced.

struct SurfaceFitSettings {
  // The number of places that a probe's own samples count as; without places it stays as it was baked.
  double own_share = 4;
};

// probes: of harmonics of order 2, with walls or without. The difference to the present coefficients
// minimises the squared error over all places, each relative to the light there, by conjugate gradients.
void fit_to_surfaces(nook::probe::Probes& probes, const TrainingPlaces& places,
                     const SurfaceFitSettings& settings = {});

}  // namespace nook::bake::probe
