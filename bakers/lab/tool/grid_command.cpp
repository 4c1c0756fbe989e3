// nook-lab evaluate grid: compares ways to look up a grid of probes, in a building of closed rooms or in a
// scene.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/images/picture.h"
#include "bakers/job/probe_bake.h"
#include "bakers/lab/probe/lookup_report.h"
#include "bakers/lab/tool/lab_commands.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/probe_options.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::lab {
namespace {

using namespace tool;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path scene, light;
  std::array<std::uint32_t, 3> counts{};  // 0: as the built-in rooms need
  BoxArgument box;
  LookupSettings settings;
  std::string direct = "all";
  bake::ImportOptions reading;
  bool no_textures = false;
  std::filesystem::path picture;
  std::string rooms = "six";
};

// Most of the six rooms have eight probes. The house has one about every 1.2 metres, as users might choose.
constexpr std::array<std::uint32_t, 3> six_rooms_counts{6, 2, 5}, house_counts{8, 3, 5};

// Draws three floor plans below each other: path traced, trilinear lookup, and lookup with walls. The scale
// is logarithmic, so that dim rooms are visible.
bake::Picture picture_of(const FloorPlan& plan) {
  constexpr int enlarged = 4;
  constexpr float darkest = 0.01f, brightest = 10;  // irradiance
  bake::Picture picture;
  picture.width = enlarged * plan.width;
  picture.height = 3 * enlarged * plan.height;
  for (const std::vector<Vec3>* panel : {&plan.traced, &plan.trilinear, &plan.walls})
    for (int row = 0; row < enlarged * plan.height; ++row)
      for (int column = 0; column < picture.width; ++column) {
        const Vec3 e = (*panel)[std::size_t(row / enlarged * plan.width + column / enlarged)];
        for (const float channel : {e.x, e.y, e.z}) {
          const float value = std::log(std::max(channel, darkest) / darkest) / std::log(brightest / darkest);
          picture.rgb.push_back(std::uint8_t(255 * std::clamp(value, 0.0f, 1.0f)));
        }
      }
  return picture;
}

Json rows_of(const Options& options, const LookupScene& scene, float origin_offset, Vec3 low_ws, Vec3 high_ws,
             const std::array<std::uint32_t, 3>& built_in = six_rooms_counts, FloorPlan* plan = nullptr) {
  LookupSettings settings = options.settings;
  settings.seed = options.common.seed;
  settings.path.origin_offset = origin_offset;
  settings.path.direct = bake::direct_of(options.direct);
  const auto counts = options.counts[0] > 0 ? options.counts : built_in;
  platform::ProgressBar bar(options.common.quiet);
  return lookup_rows(
      scene,
      bake::probe::grid_in_box(counts, options.box.given ? options.box.low_ws : low_ws,
                               options.box.given ? options.box.high_ws : high_ws),
      settings,
      [&bar](const char* step) {
        return [&bar, step = std::string(step)](std::size_t done, std::size_t total) {
          bar.show(step, "done", done, total);
          return !interrupted();
        };
      },
      plan);
}

Json evaluate(const Options& options) {
  if (options.scene.empty() != options.light.empty())
    throw ToolError(exit_bad_arguments,
                    "evaluate grid: give both --scene and --light for a scene, or neither of them for the "
                    "built-in rooms");
  Json report;
  if (options.scene.empty()) {
    const bool house = options.rooms == "house";
    const Rooms rooms = house ? make_house() : make_rooms();
    FloorPlan plan;
    report["rows"] =
        rows_of(options, {house ? "house" : "rooms", *rooms.lit, rooms.soup, &rooms}, rooms.origin_offset,
                rooms.low_ws, rooms.high_ws, house ? house_counts : six_rooms_counts,
                options.picture.empty() ? nullptr : &plan);
    if (!options.picture.empty())
      platform::OutputFile(options.picture).commit(bake::png_bytes(picture_of(plan)));
  } else {
    const bake::ProbeScene scene =
        read_probe_scene(options.scene, options.light, !options.no_textures, options.reading, options.common);
    report["rows"] = rows_of(options, {options.scene.stem().string(), *scene.lit, scene.soup},
                             scene.origin_offset, scene.low_ws, scene.high_ws);
  }
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_grid(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "grid",
      "compare methods that interpolate a grid of light probes, near walls.\nThe grid lies in built-in "
      "closed rooms, or in the scene of --scene.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  const Option scene = command.add_input(
      "--scene", o.scene, "measure in this scene, a .glb or .gltf file, instead of the built-in rooms");
  command.add_input(
      "--light", o.light,
      "with --scene (required): the environment map that lights the scene, a .hdr or .exr file");
  command
      .add_option(
          "--rooms", o.rooms,
          "which built-in rooms to measure in: six with walls of 0.1 metres, or a house with walls of 0.06 "
          "metres and a sealed cupboard")
      .excludes(scene)
      .check(one_of({"six", "house"}))
      .capture_default_str();
  command
      .add_option_function(
          "--grid", [&o](const std::string& text) { o.counts = parse_grid_counts(text); },
          "number of probes along x, y and z. Default: 6x2x5, which places eight probes in each of the six "
          "rooms, and 8x3x5 in the house")
      .type_name("AxBxC");
  command
      .add_option_function(
          "--box", [&o](const std::string& text) { o.box = parse_grid_box(text); },
          "low and high corner of the box that the grid fills, as x0,y0,z0,x1,y1,z1 in metres. Default: the "
          "box around the scene")
      .type_name("BOX");
  command
      .add_option("--points", o.settings.points,
                  "number of random points to measure on surfaces, and again in open space")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  command.add_option("--paths", o.settings.paths, "number of paths to trace from each measured point")
      .check(in_range(2u, 1u << 24))
      .capture_default_str();
  command.add_option("--samples", o.settings.samples, "number of paths to trace from each probe")
      .check(in_range(64u, 1u << 30))
      .capture_default_str();
  command
      .add_option(
          "--training-paths", o.settings.training_paths,
          "number of paths to trace from each point on a surface that walls and coefficients are fitted to")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  command
      .add_option(
          "--direct", o.direct,
          "direct light of the map to include in the comparison: none, sky (the map without its suns) or all")
      .check(one_of(bake::direct_names()))
      .capture_default_str();
  command.add_option("--picture", o.picture,
                     "for the built-in rooms: write a .png file that shows the light on the floor three "
                     "times: path traced, interpolated trilinearly, and interpolated with walls");
  add_import_options(command, o.reading);
  command.add_flag("--no-textures", o.no_textures,
                   "with --scene: do not read textures; use the colour factors of materials instead, and "
                   "treat surfaces with alpha masks as solid");
  add_common_options(command, o.common);
  command.callback([options] {
    const CommandFiles files{
        {{"--scene", options->scene}, {"--light", options->light}}, {{"--picture", options->picture}}, {}};
    run_evaluation(options->common, files, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::lab
