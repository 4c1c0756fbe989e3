// `nook bake probe` bakes one probe from an environment map, or a grid of probes in a path-traced scene.
#include "bakers/tool/bake_probe.h"
#include "bakers/tool/command_line.h"

#include <cstdio>
#include <memory>

#include "bakers/job/probe_bake.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/commands.h"
#include "sdk/src/core/geometry.h"

namespace nook::tool {
namespace {

void run(const BakeProbeOptions& options) {
  const bool is_grid = options.grid[0] > 0;
  if (is_grid != !options.light.empty())
    throw ToolError(exit_bad_arguments,
                    "bake probe: give both --grid and --light for a scene, or neither of them for a map");
  if (options.walls && (!is_grid || options.probe.basis != "harmonics" || options.probe.order != 2 ||
                        options.probe.hemisphere))
    throw ToolError(exit_bad_arguments,
                    "--walls: needs a grid with --basis harmonics and --order 2, without --hemisphere");
  BakeCommand command{
      options.common,
      options.baking,
      {{{"the input", options.input}, {"--light", options.light}}, {{"--picture", options.picture}}, {}}};
  if (is_grid && options.preview_every_s > 0)
    command.stopped =
        "stopped; " + options.baking.output.string() + " holds the latest preview, if there was one";
  command.reads_images = is_grid && !options.no_textures;
  command.makes_more = !options.picture.empty();
  run_bake(std::move(command),
           [&] { return is_grid ? prepare_probe_grid(options) : prepare_probe_of_map(options); });
}

}  // namespace

void add_bake_probe(Command bake_command) {
  const Command command = bake_command.add_subcommand(
      "probe",
      "bake a light probe from an environment map, or a grid of light probes in a scene.\nA probe stores the "
      "light from all directions at a place, by default as a few spherical Gaussians. For a grid, the light "
      "in the scene is path traced.");
  const auto options = std::make_shared<BakeProbeOptions>();
  BakeProbeOptions& o = *options;
  command
      .add_input("input", o.input,
                 "a latitude-longitude map (.hdr or .exr) for one probe, or a scene (.glb or .gltf) for a "
                 "grid of probes")
      .required();
  add_bake_options(command, o.baking);
  add_probe_options(command, o.probe);
  command
      .add_option(
          "--sampling", o.sampling,
          "for a map: how to choose the directions in which the map is read. texels takes each texel once. "
          "uniform draws random directions, and luminance draws half of them where the map is bright. "
          "automatic takes luminance if --method is a running average, and texels for the other methods")
      .check(one_of({"automatic", "texels", "luminance", "uniform"}))
      .capture_default_str();
  command
      .add_option("--samples", o.samples,
                  "for a map: number of random directions to draw; default 1048576. For a scene: largest "
                  "number of paths to trace from each probe; default 65536")
      .check(in_range(64u, 1u << 30));
  command.add_option("--picture", o.picture,
                     "for a map: write a .png file that shows the map, the radiance and irradiance of the "
                     "probe, and the error");
  command
      .add_option_function(
          "--grid", [&o](const std::string& text) { o.grid = parse_grid_counts(text); },
          "for a scene (required): number of probes along x, y and z, such as 8x4x8")
      .type_name("AxBxC");
  command.add_input("--light", o.light,
                    "for a scene (required): the environment map that lights it, a .hdr or .exr file");
  command
      .add_option_function(
          "--box", [&o](const std::string& text) { o.box = parse_grid_box(text); },
          "for a scene: low and high corner of the box that the grid fills, as x0,y0,z0,x1,y1,z1 in metres. "
          "Default: the box around the scene")
      .type_name("BOX");
  command
      .add_option("--error", o.error,
                  "for a scene: stop when the statistical error, divided by the light, is below this number")
      .check(in_range(0.0, 1.0))
      .capture_default_str();
  command
      .add_option(
          "--preview-every", o.preview_every_s,
          "for a scene: write a preview to the output file every so many seconds. Default: no preview")
      .check(in_range(0.0, 1e9));
  command.add_option("--max-bounces", o.max_bounces,
                     "for a scene: largest number of bounces of a light path. Default: no limit");
  command
      .add_option("--direct", o.direct,
                  "for a scene: direct light of the map that the probes store: none, sky (the map without "
                  "its suns) or all. The probes always store bounced light. The report lists the suns that "
                  "your engine has to draw itself")
      .check(one_of(bake::direct_names()))
      .capture_default_str();
  command.add_flag("--walls", o.walls,
                   "for a scene: prevent light from leaking through walls. The bake moves probes out of "
                   "solid objects, finds the probes on either side of each wall, and fits the probes to the "
                   "light on surfaces. Needs --basis harmonics --order 2");
  command
      .add_option("--training-paths", o.training_paths,
                  "with --walls: number of paths to trace from each point on a surface that walls and probes "
                  "are fitted to")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  add_import_options(command, o.reading);
  command.add_flag("--no-textures", o.no_textures,
                   "for a scene: do not read textures; use the colour factors of materials instead, and "
                   "treat surfaces with alpha masks as solid");
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
