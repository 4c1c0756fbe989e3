// nook evaluate probe: every way to fit a probe, and baked ones, against the maps that they stand for.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/probe/evaluate_grid.h"
#include "cli/probe/scene.h"
#include "cli/progress_bar.h"
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

void append_methods(const Options& options, const std::string& name, const bake::Environment& map,
                    ProgressBar& bar, Json& rows) {
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
  const auto irradiance = IrradianceTruth(map, region_of(probes.basis)).error(probes.basis, probes.of(0));
  return {{"map", map_name},
          {"domain", probes.basis.domain == Domain::sphere ? "sphere" : "hemisphere"},
          {"method", path.filename().string()},
          {"lobes", probes.basis.count},
          {"floats", 3 * probes.basis.count},
          {"radiance_rms", exact.rms(probes.of(0))},
          {"irradiance_rms", irradiance.rms},
          {"excess_mse", exact.excess(probes.of(0))},
          {"mean", exact.mean_ratio(probes.of(0))},
          {"irradiance_minimum", irradiance.minimum}};
}

void write_picture(const Options& options, const std::string& name, const bake::Environment& map) {
  MapBakeSettings settings;
  settings.basis = nook::probe::vogel_basis(options.lobes);
  settings.seed = options.common.seed;
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
  for (const std::filesystem::path& path : options.files) {
    if (path.extension() == ".nook") {
      if (!map)
        throw ToolError(exit_bad_arguments, path.string() + ": comes before its map; give the map first");
      report["rows"].push_back(file_row(path, name, *map));
      continue;
    }
    name = path.stem().string();
    map = std::make_unique<bake::Environment>(read_map(path));
    append_methods(options, name, *map, bar, report["rows"]);
    if (!options.images.empty()) write_picture(options, name, *map);
  }
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
  command->add_flag("--no-textures", o.grid.no_textures,
                    "of grids: colour factors stand for textures, and alpha masks are solid");
  command->add_option("--lobes", o.lobes, "spherical Gaussians of the forms that are fitted here")
      ->check(CLI::Range(1u, nook::probe::max_functions - 1))
      ->capture_default_str();
  command->add_option("--seeds", o.comparison.seeds, "independent sets of samples")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--images", o.images, "write a picture of each map and its running average here");
  add_common_options(*command, o.common);
  command->callback([options] {
    options->comparison.seed = options->common.seed;
    CommandFiles files{{{"--scene", options->grid.scene}, {"--light", options->grid.light}}, {}, options->images};
    for (const std::filesystem::path& file : options->files) files.inputs.push_back({"an input", file});
    run_evaluation(options->common, files, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::cli
