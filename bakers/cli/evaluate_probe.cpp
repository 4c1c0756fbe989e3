// nook evaluate probe: every way to fit a probe, and baked ones, against the maps that they stand for.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/probe/evaluate_grid.h"
#include "cli/probe/scene.h"
#include "cli/progress_bar.h"
#include "cli/table.h"
#include "probe/comparison.h"
#include "probe/map_bake.h"
#include "probe/map_picture.h"
#include "probe/probe_file.h"

namespace nook::cli {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

struct Options {
  CommonOptions common;
  EvaluateGridOptions grid;
  std::vector<std::filesystem::path> files;  // maps, each followed by the probes that were baked from it
  std::uint32_t lobes = 12;
  ComparisonSettings comparison;
  std::filesystem::path images;
};

constexpr std::pair<const char*, Region> domains[] = {{"sphere", {Domain::sphere, {0, 1, 0}}},
                                                      {"hemisphere", {Domain::hemisphere, {0, 1, 0}}}};

// Mean, smallest and largest error of the rotated lobes.
void add_rotations(const std::vector<double>& errors, Json& row) {
  if (errors.empty()) return;
  row["irradiance_rotated_mean"] = std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
  row["irradiance_rotated_min"] = *std::min_element(errors.begin(), errors.end());
  row["irradiance_rotated_max"] = *std::max_element(errors.begin(), errors.end());
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

// What one method does on all maps of a domain.
struct OverMaps {
  std::string domain;
  ProbeMethod method;
  std::vector<double> relative, minimum;     // of each map
  std::vector<std::vector<double>> rotated;  // of each map
};

double geometric_mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / double(values.size()));
}

Json row_over_maps(const OverMaps& all) {
  Json row{{"map", "all " + std::to_string(all.relative.size()) + ", geometric mean"},
           {"domain", all.domain},
           {"method", all.method.name},
           {"lobes", all.method.basis.count},
           {"floats", all.method.floats()},
           {"irradiance_relative", number_or_null(geometric_mean(all.relative))},
           {"irradiance_relative_max", number_or_null(*std::max_element(all.relative.begin(), all.relative.end()))},
           {"irradiance_minimum", number_or_null(*std::min_element(all.minimum.begin(), all.minimum.end()))}};
  std::vector<double> rotated;
  for (std::size_t r = 0; r < all.rotated.front().size(); ++r) {
    std::vector<double> of_map;
    for (const std::vector<double>& errors : all.rotated) of_map.push_back(errors[r]);
    rotated.push_back(geometric_mean(of_map));
  }
  add_rotations(rotated, row);
  return row;
}

void append_methods(const Options& options, const std::string& name, const bake::Environment& map,
                    ProgressBar& bar, Json& rows, std::vector<OverMaps>& over_maps) {
  std::size_t place = 0;
  for (const auto& [domain, region] : domains) {
    const std::string label = name + ", " + domain;
    const std::vector<MethodError> errors =
        compare_methods(map, probe_methods(options.lobes, region), region, options.comparison,
                        [&](std::size_t done, std::size_t total) {
                          bar.show(label, "methods", done, total);
                          return !interrupted();
                        });
    for (const MethodError& e : errors) {
      const auto batch = std::find_if(errors.begin(), errors.end(), [](const MethodError& other) {
        return other.method.name == "least_squares";
      });
      rows.push_back(method_row(name, domain, e, *batch));
      if (place == over_maps.size()) over_maps.push_back({domain, e.method, {}, {}, {}});
      over_maps[place].relative.push_back(e.irradiance_rms / e.irradiance_mean);
      over_maps[place].minimum.push_back(e.irradiance_minimum);
      over_maps[place++].rotated.push_back(e.rotated);
    }
  }
}

Json file_row(const std::filesystem::path& path, const std::string& map_name, const bake::Environment& map) {
  const std::vector<std::byte> bytes = read_file(path);
  const nook::probe::Probes probes = naming_file(path, [&] { return nook::probe::read_probes(bytes); });
  if (probes.grid.size() != 1)
    throw ToolError(exit_bad_input, path.string() + ": holds a grid of " +
                                        std::to_string(probes.grid.size()) +
                                        " probes, which no map alone can measure; give --scene and --light");
  const ExactFit exact(map, probes.basis);
  const IrradianceTruth truth(map, region_of(probes.basis));
  const auto irradiance = truth.error(probes.basis, probes.of(0));
  return {{"map", map_name},
          {"domain", probes.basis.domain == Domain::sphere ? "sphere" : "hemisphere"},
          {"method", path.filename().string()},
          {"lobes", probes.basis.count},
          {"floats", 3 * probes.basis.count},
          {"radiance_rms", exact.rms(probes.of(0))},
          {"irradiance_rms", irradiance.rms},
          {"irradiance_relative", number_or_null(irradiance.rms / truth.mean())},
          {"excess_mse", number_or_null(exact.excess(probes.of(0)))},
          {"mean", number_or_null(exact.mean_ratio(probes.of(0)))},
          {"irradiance_minimum", number_or_null(irradiance.minimum)}};
}

void write_picture(const Options& options, const std::string& name, const bake::Environment& map) {
  MapBakeSettings settings;
  settings.basis = nook::probe::vogel_basis(options.lobes);
  settings.seed = options.common.seed;
  std::filesystem::create_directories(options.images);
  constexpr std::uint32_t panel_width = 320;  // four of them fit a page
  OutputFile(options.images / (name + ".png"))
      .commit(bake::png_bytes(map_picture(map, settings.basis, bake_map(map, settings), panel_width)));
}

Json evaluate(const Options& options) {
  if (options.grid.scene.empty() != options.grid.light.empty())
    throw ToolError(exit_bad_arguments, "evaluate probe: grids need both --scene and --light, maps neither");
  if (!options.grid.scene.empty()) return evaluate_grids(options.grid, options.common, options.files);
  Json report;
  report["rows"] = Json::array();
  ProgressBar bar(options.common.quiet);
  std::string name;
  std::unique_ptr<bake::Environment> map;
  std::vector<OverMaps> over_maps;
  for (const std::filesystem::path& path : options.files) {
    if (path.extension() == ".nook") {
      if (!map)
        throw ToolError(exit_bad_arguments, path.string() + ": comes before its map; give the map first");
      report["rows"].push_back(file_row(path, name, *map));
      continue;
    }
    name = path.stem().string();
    map = std::make_unique<bake::Environment>(read_map(path));
    append_methods(options, name, *map, bar, report["rows"], over_maps);
    if (!options.images.empty()) write_picture(options, name, *map);
  }
  if (!over_maps.empty() && over_maps.front().relative.size() > 1)
    for (const OverMaps& all : over_maps) report["rows"].push_back(row_over_maps(all));
  report["seeds"] = options.comparison.seeds;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_probe(CLI::App& evaluate_command) {
  CLI::App* command = evaluate_command.add_subcommand("probe",
                                                      "all forms of fitting, spherical harmonics, ambient "
                                                      "dice and baked probes against environment maps; baked "
                                                      "grids against path tracing");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      ->add_option(
          "files", o.files,
          "latitude-longitude maps, .hdr or .exr, each followed by .nook files that were baked from it; with "
          "--scene: .nook files of grids")
      ->required();
  command->add_option("--scene", o.grid.scene,
                      "of grids: the scene that they were baked from, .glb or .gltf");
  command->add_option("--light", o.grid.light, "of grids: the map round it");
  command
      ->add_option("--points", o.grid.points, "of grids: random points on surfaces, and as many in the open")
      ->check(CLI::Range(1u, 1u << 24))
      ->capture_default_str();
  command->add_option("--paths", o.grid.paths, "of grids: for each point")
      ->check(CLI::Range(2u, 1u << 24))
      ->capture_default_str();
  command->add_option("--max-bounces", o.grid.max_bounces, "of grids: reflections that count; default all");
  command
      ->add_option("--direct", o.grid.direct,
                   "of grids: what both sides hold of the map's light that comes straight: none, the sky without suns, or all; "
                   "default as the grid was baked")
      ->check(CLI::IsMember(direct_names));
  command->add_flag("--no-textures", o.grid.no_textures,
                    "of grids: colour factors stand for textures, and alpha masks are solid");
  command->add_option("--lobes", o.lobes, "spherical Gaussians of the forms that are fitted here")
      ->check(CLI::Range(1u, nook::probe::max_functions - 1))
      ->capture_default_str();
  command->add_option("--seeds", o.comparison.seeds, "independent sets of samples")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command
      ->add_option("--rotations", o.comparison.rotations,
                   "solve the lobes' forms again with their axes rotated at random, this often, and report the spread")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_option("--images", o.images, "write a picture of each map and its lobes here");
  add_common_options(*command, o.common);
  command->callback([options] {
    options->comparison.seed = options->common.seed;
    run_evaluation(options->common, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::cli
