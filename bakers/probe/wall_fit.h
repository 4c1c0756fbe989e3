// Learns the walls of a grid's cells: the planes and masks (sdk/src/probe/probe.h) with the smallest error of
// interpolated irradiance at path-traced places. Planes and masks from distances or visibility would not know
// whose light is right at a place.
#pragma once

#include "bakers/probe/training_places.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Returns the offset of lookups along the normal in metres: a fiftieth of the shortest spacing.
float wall_bias(const nook::probe::Grid& grid);

// probes: harmonics with coefficients; ignores their walls. Any number of threads gives the same result.
nook::probe::GridWalls fit_walls(const nook::probe::Probes& probes, const TrainingPlaces& places);

// Fits the coefficients of a grid, so that interpolation between its probes has the smallest error at
// path-traced places.

struct SurfaceFitSettings {
  // A probe's own samples count as this number of places. Without places, the probe stays as baked.
  double own_share = 4;
};

// probes: harmonics of order 2, with or without walls. Changes the present coefficients by conjugate
// gradients, so that the squared error over all places is smallest, each relative to the light there.
void fit_to_surfaces(nook::probe::Probes& probes, const TrainingPlaces& places,
                     const SurfaceFitSettings& settings = {});

}  // namespace nook::bake::probe
