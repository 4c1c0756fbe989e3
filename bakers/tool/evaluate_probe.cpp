// nook evaluate probe: every way to fit a probe, and baked ones, against the maps that they stand for.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/images/picture.h"
#include "bakers/job/probe_bake.h"
#include "bakers/measure/probe/glossy_error.h"
#include "bakers/measure/probe/report.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/input_file.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/probe/evaluate_grid.h"
#include "bakers/tool/probe/scene.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {
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
  bool glossy = false;  // in place of all forms of fitting
  measure::GlossySettings surfaces;
};

void append_methods(const Options& options, const std::string& name, const bake::Environment& map,
                    platform::ProgressBar& bar, Json& rows, measure::OverMaps& over_maps) {
  for (const bool hemisphere : {false, true}) {
    const std::string label = name + (hemisphere ? ", hemisphere" : ", sphere");
    const auto progress = [&](std::size_t done, std::size_t total) {
      bar.show(label, "methods", done, total);
      return !interrupted();
    };
    const Json measured = measure::probe_method_rows(map, name, options.lobes, hemisphere, options.comparison,
                                                     progress, &over_maps);
    for (const Json& row : measured) rows.push_back(row);
  }
}

void append_glossy(const Options& options, const std::string& name, const bake::Environment& map,
                   platform::ProgressBar& bar, Json& rows) {
  measure::GlossySettings settings = options.surfaces;
  settings.lobes = options.lobes;
  settings.seed = options.common.seed;
  const auto progress = [&](std::size_t done, std::size_t total) {
    bar.show(name + ", glossy", "kinds of surface", done, total);
    return !interrupted();
  };
  for (const Json& row : measure::glossy_rows(map, name, settings, progress)) rows.push_back(row);
}

Json file_row(const std::filesystem::path& path, const std::string& map_name, const bake::Environment& map) {
  const std::vector<std::byte> bytes = read_file(path);
  return naming_file(path, [&] {
    return measure::probe_file_row(map, map_name, path.filename().string(), probe::read_probes(bytes));
  });
}

void write_picture(const Options& options, const std::string& name, const bake::Environment& map) {
  MapBakeSettings settings;
  settings.basis = nook::probe::vogel_basis(options.lobes);
  settings.seed = options.common.seed;
  constexpr std::uint32_t panel_width = 320;  // four of them fit a page
  platform::OutputFile(options.images / (name + ".png"))
      .commit(bake::png_bytes(map_picture(map, settings.basis, bake_map(map, settings), panel_width)));
}

Json evaluate(const Options& options) {
  if (options.grid.scene.empty() != options.grid.light.empty())
    throw ToolError(exit_bad_arguments, "evaluate probe: grids need both --scene and --light, maps neither");
  if (!options.grid.scene.empty()) return evaluate_grids(options.grid, options.common, options.files);
  Json report;
  report["rows"] = Json::array();
  platform::ProgressBar bar(options.common.quiet);
  std::string name;
  std::unique_ptr<bake::Environment> map;
  measure::OverMaps over_maps;
  for (const std::filesystem::path& path : options.files) {
    if (path.extension() == ".nook") {
      if (!map)
        throw ToolError(exit_bad_arguments, path.string() + ": comes before its map; give the map first");
      report["rows"].push_back(file_row(path, name, *map));
      continue;
    }
    name = path.stem().string();
    map = std::make_unique<bake::Environment>(read_map(path));
    if (options.glossy)
      append_glossy(options, name, *map, bar, report["rows"]);
    else
      append_methods(options, name, *map, bar, report["rows"], over_maps);
    if (!options.images.empty()) write_picture(options, name, *map);
  }
  for (const Json& row : over_maps.rows()) report["rows"].push_back(row);
  report["seeds"] = options.comparison.seeds;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_probe(Command evaluate_command) {
  const Command command =
      evaluate_command.add_subcommand("probe",
                                      "all forms of fitting, spherical harmonics, ambient "
                                      "dice and baked probes against environment maps; baked "
                                      "grids against path tracing");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_option(
          "files", o.files,
          "latitude-longitude maps, .hdr or .exr, each followed by .nook files that were baked from it; with "
          "--scene: .nook files of grids")
      .required();
  command.add_option("--scene", o.grid.scene, "of grids: the scene that they were baked from, .glb or .gltf");
  command.add_option("--light", o.grid.light, "of grids: the map round it");
  command
      .add_option("--points", o.grid.points, "of grids: random points on surfaces, and as many in the open")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  command.add_option("--paths", o.grid.paths, "of grids: for each point")
      .check(in_range(2u, 1u << 24))
      .capture_default_str();
  command.add_option("--max-bounces", o.grid.max_bounces, "of grids: reflections that count; default all");
  command
      .add_option("--direct", o.grid.direct,
                  "of grids: what both sides hold of the map's light that comes straight: none, the sky "
                  "without suns, or all; default as the grid was baked")
      .check(one_of(bake::direct_names()));
  add_linked_files_option(command, o.grid.linked);
  command.add_flag("--no-textures", o.grid.no_textures,
                   "of grids: colour factors stand for textures, and alpha masks are solid");
  command.add_option("--lobes", o.lobes, "spherical Gaussians of the forms that are fitted here")
      .check(in_range(1u, nook::probe::max_functions - 1))
      .capture_default_str();
  command.add_option("--seeds", o.comparison.seeds, "independent sets of samples")
      .check(in_range(1, 1000))
      .capture_default_str();
  command
      .add_option(
          "--rotations", o.comparison.rotations,
          "solve the lobes' forms again with their axes rotated at random, this often, and report the "
          "spread")
      .check(in_range(0, 1000))
      .capture_default_str();
  command.add_flag("--glossy", o.glossy,
                   "of maps: what random glossy surfaces reflect of the lobes and of the map, beside "
                   "prefiltered cube maps, in place of all forms of fitting");
  command.add_option("--surfaces", o.surfaces.surfaces, "with --glossy: random ones of each kind")
      .check(in_range(1u, 1u << 20))
      .capture_default_str();
  command.add_option("--images", o.images, "write a picture of each map and its lobes here");
  add_common_options(command, o.common);
  command.callback([options] {
    options->comparison.seed = options->common.seed;
    CommandFiles files{
        {{"--scene", options->grid.scene}, {"--light", options->grid.light}}, {}, options->images};
    for (const std::filesystem::path& file : options->files) files.inputs.push_back({"an input", file});
    run_evaluation(options->common, files, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
