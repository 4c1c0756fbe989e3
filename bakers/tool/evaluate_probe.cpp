// `nook evaluate probe` compares fits of a probe and baked probes with their maps, and baked grids with path
// tracing.
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/images/picture.h"
#include "bakers/job/probe_bake.h"
#include "bakers/measure/probe/probe_report.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/peers.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;
using namespace bake::probe;

struct EvaluateGridOptions {
  std::filesystem::path scene, light;
  std::uint32_t points = 1024;  // per kind of place
  std::uint32_t paths = 2048;   // per point
  std::uint32_t max_bounces = ~0u;
  bool no_textures = false;
  bake::ImportOptions reading;
  std::string direct;  // empty: as in each grid's bake
};

struct Options {
  CommonOptions common;
  EvaluateGridOptions grid;
  std::vector<std::filesystem::path> files;  // maps, each followed by the probes baked from it
  std::uint32_t lobes = 12;
  ComparisonSettings comparison;
  std::filesystem::path images;
};

void append_methods(const Options& options, const ProbePeers* peers, const std::string& name,
                    const bake::Environment& map, platform::ProgressBar& bar, Json& rows,
                    measure::OverMaps& over_maps) {
  for (const Domain domain : {Domain::sphere, Domain::hemisphere}) {
    const Region region{domain, {0, 1, 0}};
    const std::string label = name + (domain == Domain::hemisphere ? ", hemisphere" : ", sphere");
    const auto progress = [&](std::size_t done, std::size_t total) {
      bar.show(label, "methods", done, total);
      return !interrupted();
    };
    const Json measured = measure::probe_method_rows(
        map, name, peers ? peers->methods(options.lobes, region) : own_probe_methods(options.lobes, region),
        region, options.comparison, progress, &over_maps);
    for (const Json& row : measured) rows.push_back(row);
  }
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
  constexpr std::uint32_t panel_width = 320;  // four panels fit on a page
  platform::OutputFile(options.images / (name + ".png"))
      .commit(bake::png_bytes(map_picture(map, settings.basis, bake_map(map, settings), panel_width)));
}

void append_grid(const EvaluateGridOptions& options, const CommonOptions& common,
                 const bake::ProbeScene& scene, const std::filesystem::path& path, platform::ProgressBar& bar,
                 Json& rows) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string file = path.filename().string();
  const measure::PlacesProgress progress = [&](const char* places) {
    return [&bar, label = file + ", " + places](std::size_t done, std::size_t total) {
      bar.show(label, "points", done, total);
      return !interrupted();
    };
  };
  const Json measured = naming_file(path, [&] {
    return measure::grid_rows(*scene.lit, scene.soup, probe::read_probes(bytes),
                              {options.points, options.paths, options.max_bounces, scene.origin_offset,
                               common.seed, options.direct},
                              progress);
  });
  for (const Json& row : measured) {
    Json named{
        {"scene", options.scene.stem().string()}, {"light", options.light.stem().string()}, {"grid", file}};
    named.update(row);
    rows.push_back(named);
  }
}

Json evaluate_grids(const EvaluateGridOptions& options, const CommonOptions& common,
                    const std::vector<std::filesystem::path>& grids) {
  const bake::ProbeScene scene =
      read_probe_scene(options.scene, options.light, !options.no_textures, options.reading, common);
  Json report;
  report["rows"] = Json::array();
  platform::ProgressBar bar(common.quiet);
  for (const std::filesystem::path& grid : grids)
    append_grid(options, common, scene, grid, bar, report["rows"]);
  report["seed"] = common.seed;
  return report;
}

Json evaluate(const Options& options, const ProbePeers* peers) {
  if (options.grid.scene.empty() != options.grid.light.empty())
    throw ToolError(exit_bad_arguments,
                    "evaluate probe: give both --scene and --light for grids, or neither of them for maps");
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
        throw ToolError(
            exit_bad_arguments,
            path.string() + ": comes before its map; give each map before the files that were baked from it");
      report["rows"].push_back(file_row(path, name, *map));
      continue;
    }
    name = path.stem().string();
    map = std::make_unique<bake::Environment>(read_map(path));
    const Json instead =
        peers ? peers->rows_of_map(*map, name, options.lobes, options.common.seed, bar) : Json();
    for (const Json& row : instead) report["rows"].push_back(row);
    if (instead.is_null()) {
      append_methods(options, peers, name, *map, bar, report["rows"], over_maps);
      for (const Json& row : measure::gloss_rows(*map, name, options.lobes, options.common.seed))
        report["rows"].push_back(row);
    }
    if (!options.images.empty()) write_picture(options, name, *map);
  }
  for (const Json& row : over_maps.rows()) report["rows"].push_back(row);
  report["seeds"] = options.comparison.seeds;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_probe(Command evaluate_command) {
  add_evaluate_probe(evaluate_command, nullptr);
}

void add_evaluate_probe(Command evaluate_command, std::shared_ptr<ProbePeers> peers) {
  const Command command = evaluate_command.add_subcommand(
      "probe",
      "measure light probes, and grids of light probes.\nA probe is compared with the environment map that "
      "it was baked from. A grid is compared with path tracing in its scene.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_input("files", o.files,
                 "for probes: latitude-longitude maps (.hdr or .exr), each followed by the .nook files that "
                 "were baked from it. For grids: the .nook files, with --scene and --light")
      .required();
  command.add_input("--scene", o.grid.scene,
                    "for grids (required): the scene that the grids were baked from, a .glb or .gltf file");
  command.add_input("--light", o.grid.light,
                    "for grids (required): the environment map that lights the scene, a .hdr or .exr file");
  command
      .add_option("--points", o.grid.points,
                  "for grids: number of random points to measure on surfaces, and again in open space")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  command.add_option("--paths", o.grid.paths, "for grids: number of paths to trace from each measured point")
      .check(in_range(2u, 1u << 24))
      .capture_default_str();
  command.add_option("--max-bounces", o.grid.max_bounces,
                     "for grids: largest number of bounces of a path. Default: no limit");
  command
      .add_option("--direct", o.grid.direct,
                  "for grids: direct light of the map to include in the comparison: none, sky (the map "
                  "without its suns) or all. Default: as in the bake of the grid")
      .check(one_of(bake::direct_names()));
  add_import_options(command, o.grid.reading);
  command.add_flag("--no-textures", o.grid.no_textures,
                   "for grids: do not read textures; use the colour factors of materials instead, and treat "
                   "surfaces with alpha masks as solid");
  command
      .add_option("--lobes", o.lobes,
                  "for maps: number of lobes (spherical Gaussians) in the probes that this command fits for "
                  "comparison")
      .check(in_range(1u, nook::probe::max_functions - 1))
      .capture_default_str();
  command
      .add_option("--seeds", o.comparison.seeds,
                  "for maps: number of times to repeat each of these fits, each time with other samples")
      .check(in_range(1, 1000))
      .capture_default_str();
  command
      .add_option("--rotations", o.comparison.rotations,
                  "for maps: number of times to repeat the fits of lobes with randomly rotated axes. The "
                  "report then contains the errors of all rotations")
      .check(in_range(0, 1000))
      .capture_default_str();
  command.add_option("--images", o.images, "write a PNG file of each map and of its lobes into this folder");
  if (peers) peers->add_options(command);
  add_common_options(command, o.common);
  command.callback([options, peers] {
    options->comparison.seed = options->common.seed;
    CommandFiles files{
        {{"--scene", options->grid.scene}, {"--light", options->grid.light}}, {}, options->images};
    for (const std::filesystem::path& file : options->files) files.inputs.push_back({"an input", file});
    run_evaluation(options->common, files, [&] { return evaluate(*options, peers.get()); });
  });
}

}  // namespace nook::tool
