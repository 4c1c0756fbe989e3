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
                    "bake probe: a scene needs both --grid and --light, a map needs neither");
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
      "bake a light probe from an environment map, or a grid of light probes in a scene.\nEach probe stores "
      "light as a few spherical Gaussians. A scene is path traced.");
  const auto options = std::make_shared<BakeProbeOptions>();
  BakeProbeOptions& o = *options;
  command.add_input("input", o.input, "a latitude-longitude map (.hdr or .exr), or a scene (.glb or .gltf)")
      .required();
  add_bake_options(command, o.baking);
  add_probe_options(command, o.probe);
  command
      .add_option(
          "--sampling", o.sampling,
          "for a map: how to choose samples. texels takes each texel once, luminance and uniform draw texels "
          "at random; automatic is texels if --method solves for all samples at once, otherwise luminance")
      .check(one_of({"automatic", "texels", "luminance", "uniform"}))
      .capture_default_str();
  command
      .add_option("--samples", o.samples,
                  "for a map: number of samples to draw, default 1048576; for a scene: largest number of "
                  "samples per probe, default 65536")
      .check(in_range(64u, 1u << 30));
  command.add_option("--picture", o.picture,
                     "for a map: write one .png that shows the map, the radiance and irradiance of the "
                     "probe, and the error");
  command
      .add_option_function(
          "--grid", [&o](const std::string& text) { o.grid = parse_grid_counts(text); },
          "for a scene: number of probes along x, y and z")
      .type_name("AxBxC");
  command.add_input("--light", o.light, "for a scene: the environment map around it");
  command
      .add_option_function(
          "--box", [&o](const std::string& text) { o.box = parse_grid_box(text); },
          "for a scene: the box that the grid fills, as x0,y0,z0,x1,y1,z1 in metres; default the whole scene")
      .type_name("BOX");
  command
      .add_option("--error", o.error,
                  "for a scene: stop when the statistical error falls below this share of the light")
      .check(in_range(0.0, 1.0))
      .capture_default_str();
  command
      .add_option("--preview-every", o.preview_every_s,
                  "for a scene: write a preview to the output file each time this many seconds have passed")
      .check(in_range(0.0, 1e9));
  command.add_option("--max-bounces", o.max_bounces,
                     "for a scene: largest number of bounces; default unlimited");
  command
      .add_option(
          "--direct", o.direct,
          "for a scene: which direct light of the map the probes store: none, the sky without suns, or all. "
          "Bounced light is always stored. The report lists the suns that your engine then has to draw")
      .check(one_of(bake::direct_names()))
      .capture_default_str();
  command.add_flag("--walls", o.walls,
                   "for a scene: move probes out of solids, learn which probes lie on which side of a wall, "
                   "and fit the probes to the light on surfaces; needs --basis harmonics --order 2");
  command
      .add_option("--training-paths", o.training_paths,
                  "with --walls: number of paths to trace from each point on surfaces to which walls and "
                  "probes are fitted")
      .check(in_range(1u, 1u << 24))
      .capture_default_str();
  add_import_options(command, o.reading);
  command.add_flag("--no-textures", o.no_textures,
                   "for a scene: use colour factors in place of textures, and treat alpha masks as solid");
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
