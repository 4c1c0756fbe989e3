// Bakes the probes of a file: one probe from an environment map, or a grid of probes in a scene.
#pragma once

#include <functional>

#include "bakers/probe/grid_bake.h"
#include "bakers/probe/map_bake.h"
#include "bakers/probe/training_places.h"
#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe_file.h"

namespace nook::bake {

// Returns a hash of the map's texels, as 64 hexadecimal digits.
std::string content_hash(const Environment& map);

struct MapProbe {
  nook::probe::Probes probes;
  std::size_t samples = 0;
};
// `progress` counts samples. Throws Failure (CANCELLED) when it returns false.
MapProbe bake_map_probe(const Environment& map, const probe::MapBakeSettings& settings,
                        const Progress& progress);

struct GridRefinement {
  std::uint32_t max_passes = 1;
  double error = 0.01;  // the bake ends when the statistical error is this small, see probe::GridBake::error
  double preview_every_s = 0;                 // seconds; 0: no previews
  Progress progress;                          // counts passes; return false to stop with Failure (CANCELLED)
  std::function<void(double error)> preview;  // called between two passes
};
// Adds passes until the error is small enough or all passes are done. Returns the remaining error.
double refine_grid(probe::GridBake& bake, const GridRefinement& refinement);

// Adds walls to a baked grid, and fits the coefficients to the surfaces behind the walls. `probes` must be
// spherical harmonics of order 2. `progress` counts the traced places.
void add_walls(nook::probe::Probes& probes, const LitScene& scene, const probe::TrainingSettings& settings,
               const Progress& progress = {});

}  // namespace nook::bake
