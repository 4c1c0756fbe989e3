// Coefficients of a grid, fitted so that what is interpolated between its probes has the smallest error at
// places where irradiance was path traced.
#pragma once

#include "bakers/probe/training_places.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

struct SurfaceFitSettings {
  // The number of places that a probe's own samples count as; without places it stays as it was baked.
  double own_share = 4;
};

// probes: of harmonics of order 2, with walls or without. The difference to the present coefficients
// minimises the squared error over all places, each relative to the light there, by conjugate gradients.
void fit_to_surfaces(nook::probe::Probes& probes, const TrainingPlaces& places,
                     const SurfaceFitSettings& settings = {});

}  // namespace nook::bake::probe
