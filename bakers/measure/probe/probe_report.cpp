#include "bakers/measure/probe/probe_report.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bakers/measure/probe/gloss_error.h"
#include "bakers/probe/map_bake.h"
#include "sdk/src/core/failure.h"

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

// Returns null if the value is not finite, for example an error relative to a black map. Tables show null as
// "-".
Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

// Adds the mean, smallest and largest error of the rotated lobes.
void add_rotations(const std::vector<double>& errors, Json& row) {
  if (errors.empty()) return;
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  row["irradiance_rotated_mean"] = number_or_null(sum / double(errors.size()));
  row["irradiance_rotated_min"] = number_or_null(*std::ranges::min_element(errors));
  row["irradiance_rotated_max"] = number_or_null(*std::ranges::max_element(errors));
}

Json method_row(const std::string& map, const char* domain, const MethodError& e, const MethodError& batch) {
  Json row{{"map", map},
           {"domain", domain},
           {"method", e.method.name},
           {"lobes", e.method.basis.count},
           {"floats", e.method.floats()},
           {"radiance_rms", e.radiance_rms},
           {"irradiance_rms", e.irradiance_rms},
           {"irradiance_rms_fitted", e.irradiance_rms_fitted},
           {"irradiance_rms_inner_product", e.irradiance_rms_inner_product},
           {"irradiance_relative", number_or_null(e.irradiance_rms / e.irradiance_mean)},
           {"excess_mse_1024", number_or_null(e.uniform_1024.excess_mse)},
           {"excess_mse_20000", number_or_null(e.uniform_20000.excess_mse)},
           {"distance_1024", number_or_null(e.uniform_1024.distance)},
           {"distance_20000", number_or_null(e.uniform_20000.distance)},
           {"distance_ratio_1024", number_or_null(e.uniform_1024.distance / batch.uniform_1024.distance)},
           {"distance_ratio_20000", number_or_null(e.uniform_20000.distance / batch.uniform_20000.distance)},
           {"mean", number_or_null(e.mean_ratio)},
           {"irradiance_minimum", number_or_null(e.irradiance_minimum)},
           {"luminance_excess_20000", number_or_null(e.luminance_20000.excess_mse)},
           {"luminance_mean", number_or_null(e.luminance_20000.mean_ratio)},
           {"luminance_mean_worst", number_or_null(e.luminance_20000.mean_worst)},
           {"luminance_irradiance_minimum", number_or_null(e.luminance_20000.irradiance_minimum)}};
  add_rotations(e.rotated, row);
  return row;
}

Json error_row(const GridError& e) {
  return {{"irradiance_mean", e.mean},
          {"irradiance_rms", e.rms},
          {"irradiance_rms_relative", number_or_null(e.rms / e.mean)},
          {"irradiance_bias_relative", number_or_null(e.bias / e.mean)},
          {"irradiance_worst_relative", number_or_null(e.worst / e.mean)},
          {"noise_rms_relative", number_or_null(e.noise / e.mean)}};
}

Json gloss_keys(const GlossError& e) {
  return {{"gloss_dark", e.dark},
          {"gloss_negative", e.negative},
          {"gloss_lowest", number_or_null(e.lowest)},
          {"gloss_rms", number_or_null(e.rms)},
          {"gloss_mean", number_or_null(e.mean)}};
}

std::vector<SphericalGaussian> lobes_of(const Basis& basis, std::span<const Vec3> amplitudes) {
  std::vector<SphericalGaussian> lobes(basis.count);
  nook::probe::to_lobes(basis, amplitudes, lobes);
  return lobes;
}

// Adds the errors of reflections in a metal ball, for the amplitudes that glossy reflection reads. Only files
// with lobes over the whole sphere have such amplitudes.
void add_gloss(const bake::Environment& map, const nook::probe::Probes& probes, Json& row) {
  const Basis& basis = probes.basis;
  if (basis.kind != nook::probe::BasisKind::gaussians || basis.domain != Domain::sphere) return;
  const std::span<const Vec3> amplitudes =
      probes.has_gloss() ? std::span<const Vec3>(probes.gloss).first(basis.count) : probes.of(0);
  const GlossError all = GlossTruth(map).errors(lobes_of(basis, amplitudes)).back();
  row["gloss_dark"] = all.dark;
  row["gloss_negative"] = all.negative;
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / double(values.size()));
}

// Returns the name of the direct light in the grid's recipe, or "all" if the recipe has none.
std::string direct_of_recipe(const nook::probe::Probes& probes) {
  const Json recipe = Json::parse(probes.recipe, nullptr, false);
  const Json direct = recipe.is_object() ? recipe.value("direct", Json()) : Json();
  for (const std::string& known : bake::direct_names())
    if (direct == known) return known;
  return "all";
}

}  // namespace

Json sun_rows(const bake::Environment& map) {
  constexpr std::size_t max_suns = 4;
  Json suns = Json::array();
  for (const bake::Sun& sun : bake::find_suns(map, max_suns))
    suns.push_back({{"direction", {sun.direction.x, sun.direction.y, sun.direction.z}},
                    {"irradiance", {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z}},
                    {"solid_angle", sun.solid_angle}});
  return suns;
}

Json probe_method_rows(const bake::Environment& map, const std::string& map_name,
                       const std::vector<ProbeMethod>& methods, const Region& region,
                       const ComparisonSettings& settings, const bake::Progress& progress,
                       OverMaps* over_maps) {
  const std::vector<MethodError> errors = compare_methods(map, methods, region, settings, progress);
  const auto batch = std::find_if(errors.begin(), errors.end(), [](const MethodError& error) {
    return error.method.name == "least_squares";
  });
  Json rows = Json::array();
  const char* const domain = region.domain == Domain::hemisphere ? "hemisphere" : "sphere";
  for (const MethodError& error : errors) {
    rows.push_back(method_row(map_name, domain, error, *batch));
    if (over_maps) over_maps->add(domain, error);
  }
  return rows;
}

void OverMaps::add(const std::string& domain, const MethodError& error) {
  const auto same = [&](const Method& m) { return m.domain == domain && m.name == error.method.name; };
  auto at = std::ranges::find_if(methods_, same);
  if (at == methods_.end())
    at = methods_.insert(at, {domain, error.method.name, error.method.floats(), {}, {}, {}});
  at->relative.push_back(error.irradiance_rms / error.irradiance_mean);
  at->minimum.push_back(error.irradiance_minimum);
  at->rotated.push_back(error.rotated);
}

Json OverMaps::rows() const {
  Json rows = Json::array();
  for (const Method& method : methods_) {
    if (method.relative.size() < 2) continue;
    Json row{{"map", "geometric mean of " + std::to_string(method.relative.size())},
             {"domain", method.domain},
             {"method", method.name},
             {"lobes", method.floats / 3},
             {"floats", method.floats},
             {"irradiance_relative", number_or_null(geometric_mean(method.relative))},
             {"irradiance_relative_max", number_or_null(*std::ranges::max_element(method.relative))},
             {"irradiance_minimum", number_or_null(*std::ranges::min_element(method.minimum))}};
    std::vector<double> rotated;
    for (std::size_t r = 0; r < method.rotated.front().size(); ++r) {
      std::vector<double> of_map;
      for (const std::vector<double>& errors : method.rotated) of_map.push_back(errors[r]);
      rotated.push_back(geometric_mean(of_map));
    }
    add_rotations(rotated, row);
    rows.push_back(row);
  }
  return rows;
}

Json probe_errors(const bake::Environment& map, const nook::probe::Probes& probes) {
  const ExactFit exact(map, probes.basis);
  const IrradianceTruth truth(map, region_of(probes.basis));
  const auto irradiance = truth.error(probes.basis, probes.of(0));
  return {{"radiance_rms", exact.rms(probes.of(0))},
          {"irradiance_rms", irradiance.rms},
          {"irradiance_relative", number_or_null(irradiance.rms / truth.mean())},
          {"excess_mse", number_or_null(exact.excess(probes.of(0)))},
          {"mean_ratio", number_or_null(exact.mean_ratio(probes.of(0)))},
          {"irradiance_minimum", number_or_null(irradiance.minimum)}};
}

Json probe_file_row(const bake::Environment& map, const std::string& map_name, const std::string& file_name,
                    const nook::probe::Probes& probes) {
  if (probes.grid.size() != 1)
    throw Failure(NOOK_ERROR_BAD_FILE,
                  "contains a grid of %zu probes, which a map alone cannot measure; give --scene and --light",
                  std::size_t(probes.grid.size()));
  const Json errors = probe_errors(map, probes);
  Json row{{"map", map_name},
           {"domain", probes.basis.domain == Domain::sphere ? "sphere" : "hemisphere"},
           {"method", file_name},
           {"lobes", probes.basis.count},
           {"floats", 3 * probes.basis.count},
           {"radiance_rms", errors["radiance_rms"]},
           {"irradiance_rms", errors["irradiance_rms"]},
           {"irradiance_relative", errors["irradiance_relative"]},
           {"excess_mse", errors["excess_mse"]},
           {"mean", errors["mean_ratio"]},
           {"irradiance_minimum", errors["irradiance_minimum"]}};
  add_gloss(map, probes, row);
  return row;
}

Json gloss_rows(const bake::Environment& map, const std::string& map_name, std::uint32_t lobes,
                std::uint64_t seed) {
  MapBakeSettings settings;
  settings.basis = nook::probe::vogel_basis(lobes);
  settings.seed = seed;
  const std::pair<const char*, std::vector<Vec3>> amplitudes[] = {
      {"gloss of the light's amplitudes", bake_map(map, settings)},
      {"gloss of the light's amplitudes, without suns", bake_map(bake::without_suns(map), settings)},
      {"gloss of its own amplitudes", map_gloss(map, settings.basis)}};
  const GlossTruth truth(map);
  Json rows = Json::array();
  for (const auto& [name, own] : amplitudes) {
    const std::vector<GlossError> errors = truth.errors(lobes_of(settings.basis, own));
    for (std::size_t r = 0; r < errors.size(); ++r) {
      Json row{{"map", map_name}, {"domain", "sphere"}, {"method", name}, {"lobes", lobes}};
      if (r < std::size(gloss_roughness))
        row["roughness"] = std::round(100 * double(gloss_roughness[r])) / 100;
      else
        row["roughness"] = "all";
      row.update(gloss_keys(errors[r]));
      rows.push_back(row);
    }
  }
  return rows;
}

Json grid_rows(const bake::LitScene& scene, const bake::TriangleSoup& soup, const nook::probe::Probes& probes,
               const GridReportSettings& settings, const PlacesProgress& progress) {
  const std::vector<bool> inside = inside_probes(scene, probes.grid);
  const std::string direct = settings.direct.empty() ? direct_of_recipe(probes) : settings.direct;
  const bake::PathSettings trace{settings.max_bounces, settings.origin_offset, bake::direct_of(direct)};
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
    Json row{{"direct", direct},
             {"places", name},
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
