// Measures the irradiance of a grid of probes against path tracing.
#pragma once

#include <cstdint>
#include <vector>

#include "bakers/import/static_scene.h"
#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/probe/probe.h"

namespace nook::bake::probe {

struct Places {
  std::vector<Vec3> position_ws;
  std::vector<Vec3> normal;
  float lookup_offset = 0;  // how far lookups are moved along the normal, in grid spacings
};

// Returns random points, distributed uniformly over the surfaces inside the box of the grid's cells. Each
// point is on the side of the surface that is outside solids. If both sides are outside solids, as with a
// thin sheet, the point is on the side that sees the nearest probe outside solids. origin_offset is the
// distance of the points from the surface, in metres.
Places places_on_surfaces(const LitScene& scene, const TriangleSoup& soup, const nook::probe::Grid& grid,
                          const std::vector<bool>& inside, float origin_offset, std::size_t count,
                          std::uint64_t seed);

// Returns random points with random normals. The points are inside the box of the grid's cells and outside
// solids.
Places places_in_the_open(const LitScene& scene, const nook::probe::Grid& grid, std::size_t count,
                          std::uint64_t seed);

struct GridError {
  double mean = 0;   // mean of the path-traced irradiance over places and channels
  double rms = 0;    // root mean square difference, without the noise of the path tracer
  double worst = 0;  // largest difference at any place and channel, including noise
  double bias = 0;   // mean difference
  double noise = 0;  // rms error of the path-traced irradiance itself
};

// Path-traced irradiance at the places. Each half of the paths gives a separate result. The noise is
// estimated from the difference of the two results.
struct TracedPlaces {
  std::vector<Vec3> first, second;
  Vec3 mean(std::size_t i) const { return 0.5f * (first[i] + second[i]); }
};
TracedPlaces trace_places(const LitScene& scene, const Places& places, std::uint32_t paths,
                          std::uint64_t seed, const PathSettings& path, const Progress& progress = {});
// Returns the error of the irradiance `found`, over some of the places.
GridError error_of(const TracedPlaces& truth, const std::vector<Vec3>& found,
                   const std::vector<std::size_t>& which);

// `paths` is the number of paths per place, at least 2. The paths are split into two halves, and the noise is
// estimated from the difference of the halves.
GridError grid_error(const LitScene& scene, const nook::probe::Probes& probes, const Places& places,
                     std::uint32_t paths, std::uint64_t seed, const PathSettings& path,
                     const Progress& progress = {});

}  // namespace nook::bake::probe
