#include "bakers/measure/probe/report.h"

#include <algorithm>

#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

Json method_row(const std::string& map, const char* domain, const MethodError& e, const MethodError& batch) {
  return {{"map", map},
          {"domain", domain},
          {"method", e.method.name},
          {"lobes", e.method.basis.count},
          {"floats", e.method.floats()},
          {"radiance_rms", e.radiance_rms},
          {"irradiance_rms", e.irradiance_rms},
          {"irradiance_rms_fitted", e.irradiance_rms_fitted},
          {"irradiance_rms_inner_product", e.irradiance_rms_inner_product},
          {"excess_mse_1024", e.uniform_1024.excess_mse},
          {"excess_mse_20000", e.uniform_20000.excess_mse},
          {"distance_1024", e.uniform_1024.distance},
          {"distance_20000", e.uniform_20000.distance},
          {"distance_ratio_1024", e.uniform_1024.distance / batch.uniform_1024.distance},
          {"distance_ratio_20000", e.uniform_20000.distance / batch.uniform_20000.distance},
          {"mean", e.mean_ratio},
          {"irradiance_minimum", e.irradiance_minimum},
          {"luminance_excess_20000", e.luminance_20000.excess_mse},
          {"luminance_mean", e.luminance_20000.mean_ratio},
          {"luminance_mean_worst", e.luminance_20000.mean_worst},
          {"luminance_irradiance_minimum", e.luminance_20000.irradiance_minimum}};
}

Json error_row(const GridError& e) {
  return {{"irradiance_mean", e.mean},
          {"irradiance_rms", e.rms},
          {"irradiance_rms_relative", e.rms / e.mean},
          {"irradiance_bias_relative", e.bias / e.mean},
          {"irradiance_worst_relative", e.worst / e.mean},
          {"noise_rms_relative", e.noise / e.mean}};
}

}  // namespace

Json probe_method_rows(const bake::Environment& map, const std::string& map_name, std::uint32_t lobes,
                       bool hemisphere, const ComparisonSettings& settings, const bake::Progress& progress) {
  const Region region{hemisphere ? Domain::hemisphere : Domain::sphere, {0, 1, 0}};
  const std::vector<MethodError> errors =
      compare_methods(map, probe_methods(lobes, region), region, settings, progress);
  const auto batch = std::find_if(errors.begin(), errors.end(), [](const MethodError& error) {
    return error.method.name == "least_squares";
  });
  Json rows = Json::array();
  for (const MethodError& error : errors)
    rows.push_back(method_row(map_name, hemisphere ? "hemisphere" : "sphere", error, *batch));
  return rows;
}

Json probe_errors(const bake::Environment& map, const nook::probe::Probes& probes) {
  const ExactFit exact(map, probes.basis);
  const auto irradiance = IrradianceTruth(map, region_of(probes.basis)).error(probes.basis, probes.of(0));
  return {{"radiance_rms", exact.rms(probes.of(0))},
          {"irradiance_rms", irradiance.rms},
          {"excess_mse", exact.excess(probes.of(0))},
          {"mean_ratio", exact.mean_ratio(probes.of(0))},
          {"irradiance_minimum", irradiance.minimum}};
}

Json probe_file_row(const bake::Environment& map, const std::string& map_name, const std::string& file_name,
                    const nook::probe::Probes& probes) {
  if (probes.grid.size() != 1)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "holds a grid of %zu probes, which no map alone can measure; give --scene and --light",
                  std::size_t(probes.grid.size()));
  const Json errors = probe_errors(map, probes);
  return {{"map", map_name},
          {"domain", probes.basis.domain == Domain::sphere ? "sphere" : "hemisphere"},
          {"method", file_name},
          {"lobes", probes.basis.count},
          {"floats", 3 * probes.basis.count},
          {"radiance_rms", errors["radiance_rms"]},
          {"irradiance_rms", errors["irradiance_rms"]},
          {"excess_mse", errors["excess_mse"]},
          {"mean", errors["mean_ratio"]},
          {"irradiance_minimum", errors["irradiance_minimum"]}};
}

Json grid_rows(const bake::LitScene& scene, const bake::TriangleSoup& soup, const nook::probe::Probes& probes,
               const GridReportSettings& settings, const PlacesProgress& progress) {
  const std::vector<bool> inside = inside_probes(scene, probes.grid);
  const bake::PathSettings trace{settings.max_bounces, settings.origin_offset};
  const Places surfaces = places_on_surfaces(scene, soup, probes.grid, inside, settings.origin_offset,
                                             settings.points, settings.seed);
  const Places open = places_in_the_open(scene, probes.grid, settings.points, settings.seed);
  Places off = surfaces;
  off.lookup_offset = 0.5f;
  const std::pair<const char*, const Places&> kinds[] = {
      {"on surfaces", surfaces}, {"on surfaces, looked up half a cell off", off}, {"in the open", open}};
  Json rows = Json::array();
  for (const auto& [name, places] : kinds) {
    const GridError error =
        grid_error(scene, probes, places, settings.paths, settings.seed, trace, progress(name));
    Json row{{"places", name},
             {"probes", probes.grid.size()},
             {"probes_inside", std::count(inside.begin(), inside.end(), true)},
             {"lobes", probes.basis.count},
             {"floats", 3 * probes.basis.count},
             {"points", places.normal.size()},
             {"paths", settings.paths / 2 * 2}};
    row.update(error_row(error));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace nook::measure
