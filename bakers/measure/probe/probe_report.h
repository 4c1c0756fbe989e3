// Makes the rows of the reports on probes that `nook bake probe` and `nook evaluate probe` print.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/measure/probe/grid_error.h"
#include "bakers/measure/probe/method_error.h"
#include "bakers/probe/inside_probes.h"
#include "bakers/raytrace/lit_scene.h"
#include "bakers/raytrace/path_tracer.h"
#include "sdk/src/probe/probe_file.h"

namespace nook::measure {

// Collects the errors of each method over several maps.
class OverMaps {
 public:
  void add(const std::string& domain, const bake::probe::MethodError& error);
  // Returns a row for each method that was measured on two or more maps. The row has the geometric mean and
  // the maximum of irradiance_relative, and the lowest irradiance.
  nlohmann::ordered_json rows() const;

 private:
  struct Method {
    std::string domain, name;
    std::size_t floats = 0;
    std::vector<double> relative, minimum;     // per map
    std::vector<std::vector<double>> rotated;  // per map, one for each rotation
  };
  std::vector<Method> methods_;
};

// Returns a row for each way to fit a probe to the map, including "least_squares". The region is the sphere,
// or the hemisphere above the horizon. If over_maps is not null, also adds the results to it. Ratios relative
// to a black map are null.
nlohmann::ordered_json probe_method_rows(const bake::Environment& map, const std::string& map_name,
                                         const std::vector<bake::probe::ProbeMethod>& methods,
                                         const bake::probe::Region& region,
                                         const bake::probe::ComparisonSettings& settings,
                                         const bake::Progress& progress, OverMaps* over_maps = nullptr);

// Compares a baked probe with its map. The keys are radiance_rms, irradiance_rms, irradiance_relative,
// excess_mse, mean_ratio and irradiance_minimum.
nlohmann::ordered_json probe_errors(const bake::Environment& map, const probe::Probes& probes);

// Returns rows about reflections in a metal ball. The ball reflects the lobes that `nook bake probe` fits to
// the map, over all directions. There are rows for three sets of lobe amplitudes: for the light, for the
// light without suns, and for glossy reflection. Each set has one row for every roughness and one row for all
// of them together. GlossError explains the keys gloss_dark, gloss_negative, gloss_lowest, gloss_rms and
// gloss_mean. The reference is the map without its suns.
nlohmann::ordered_json gloss_rows(const bake::Environment& map, const std::string& map_name,
                                  std::uint32_t lobes, std::uint64_t seed);

// Compares a baked file with its map. If the file has lobes over the whole sphere, the row also has
// gloss_dark and gloss_negative over all roughnesses, for the amplitudes that glossy reflection reads. Throws
// Failure (BAD_FILE) for a grid, because a map alone cannot measure it.
nlohmann::ordered_json probe_file_row(const bake::Environment& map, const std::string& map_name,
                                      const std::string& file_name, const probe::Probes& probes);

// Returns the map's brightest suns, at most four: direction, RGB irradiance on a surface that faces it, and
// solid angle.
nlohmann::ordered_json sun_rows(const bake::Environment& map);

struct GridReportSettings {
  std::uint32_t points = 1024;  // per kind of place
  std::uint32_t paths = 2048;   // per point
  std::uint32_t max_bounces = ~0u;
  float origin_offset = 0;  // metres along the normal
  std::uint64_t seed = 1;
  std::string direct;  // the direct light of the map that both the grid and the reference include; empty: as
                       // in the grid's recipe
};

// Returns the progress callback for the points of one kind of place.
using PlacesProgress = std::function<bake::Progress(const char* places)>;

// Returns three rows, without file names. The first is for points on surfaces. The second is for the same
// points with lookups offset by half a cell along the normal. The third is for points in the open.
nlohmann::ordered_json grid_rows(const bake::LitScene& scene, const bake::TriangleSoup& soup,
                                 const probe::Probes& probes, const GridReportSettings& settings,
                                 const PlacesProgress& progress);

}  // namespace nook::measure
