// Places in the cells of a grid, with path-traced irradiance. The walls and the coefficients of a grid are
// fitted to them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

struct TrainingSettings {
  std::uint32_t origins = 24;  // ray origins per cell
  // Rays per origin. Each hit gives a place on a surface, and every fourth ray also a place in open space.
  std::uint32_t rays = 8;
  std::uint32_t paths = 128;  // paths per place
  std::uint64_t seed = 1;
  PathSettings path;
};

struct TrainingPlaces {
  std::vector<Vec3> position_ws, normal, irradiance;
  std::vector<char> on_surface;
  std::size_t size() const { return normal.size(); }
};

// Chooses places on surfaces that are visible from open space in the grid's box, and places in open space
// with random normals. The result does not depend on the number of threads. `progress` counts places.
TrainingPlaces training_places(const LitScene& scene, const nook::probe::Grid& grid,
                               const TrainingSettings& settings, const Progress& progress = {});

}  // namespace nook::bake::probe
