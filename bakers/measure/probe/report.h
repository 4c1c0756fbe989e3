// Rows of the reports on probes, as `nook bake probe` and `nook evaluate probe` print them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/measure/probe/comparison.h"
#include "bakers/measure/probe/grid_error.h"
#include "bakers/probe/inside_probes.h"
#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe_file.h"

namespace nook::measure {

// Every way to fit a probe to the map, over the sphere or the hemisphere above the horizon: a row each.
nlohmann::ordered_json probe_method_rows(const bake::Environment& map, const std::string& map_name,
                                         std::uint32_t lobes, bool hemisphere,
                                         const bake::probe::ComparisonSettings& settings,
                                         const bake::Progress& progress);

// A baked probe against its map, the keys radiance_rms, irradiance_rms, excess_mse, mean_ratio and
// irradiance_minimum.
nlohmann::ordered_json probe_errors(const bake::Environment& map, const probe::Probes& probes);

// A baked file against its map. Throws Failure (BAD_FILE) for a grid, which no map alone can measure.
nlohmann::ordered_json probe_file_row(const bake::Environment& map, const std::string& map_name,
                                      const std::string& file_name, const probe::Probes& probes);

struct GridReportSettings {
  std::uint32_t points = 1024;  // of each kind
  std::uint32_t paths = 2048;   // a point
  std::uint32_t max_bounces = ~0u;
  float origin_offset = 0;  // metres along the normal
  std::uint64_t seed = 1;
};

// Returns the progress of the points of one kind of place.
using PlacesProgress = std::function<bake::Progress(const char* places)>;

// Three rows: points on surfaces, the same with probes looked up half a cell off along the normal, and points
// in the open. The rows lack the names of the files.
nlohmann::ordered_json grid_rows(const bake::LitScene& scene, const bake::TriangleSoup& soup,
                                 const probe::Probes& probes, const GridReportSettings& settings,
                                 const PlacesProgress& progress);

}  // namespace nook::measure
