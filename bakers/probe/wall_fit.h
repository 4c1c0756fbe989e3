// Fits the walls of a grid's cells: the planes and masks (sdk/src/probe/probe.h) that give the smallest error
// of interpolated irradiance at path-traced places. Distances or visibility alone would not show which probes
// have the right light for a place.
#pragma once

#include "bakers/probe/training_places.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

// Returns how far look-ups are moved along the normal, in metres: a fiftieth of the shortest spacing.
float wall_bias(const nook::probe::Grid& grid);

// `probes` must be harmonics with coefficients. Existing walls are ignored. The result does not depend on the
// number of threads.
nook::probe::GridWalls fit_walls(const nook::probe::Probes& probes, const TrainingPlaces& places);

// Fits the coefficients of a grid, to minimise the error of interpolated irradiance at path-traced places.

struct SurfaceFitSettings {
  // The baked coefficients of a probe count as much as this number of places. A probe without places keeps
  // its baked coefficients.
  double own_share = 4;
};

// `probes` must be harmonics of order 2, with or without walls. Changes the coefficients by conjugate
// gradients to minimise the sum of squared errors over all places. Each error is relative to the light at its
// place.
void fit_to_surfaces(nook::probe::Probes& probes, const TrainingPlaces& places,
                     const SurfaceFitSettings& settings = {});

}  // namespace nook::bake::probe
