#include "bakers/lab/tool/nnao_options.h"

#include <cstdio>

#include "bakers/lab/nnao/screen_baselines.h"
#include "bakers/lab/nnao/screen_comparison.h"
#include "bakers/measure/nnao/frame_comparison.h"
#include "bakers/measure/nnao/oracle_pass.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"

namespace nook::lab {

using namespace measure;
using namespace tool;

void parse_size(const std::string& text, TruthSettings& truth) {
  unsigned width = 0, height = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &used) != 2 || std::size_t(used) != text.size() ||
      width < 16 || height < 16 || width > 4096 || height > 4096)
    throw ToolError(exit_bad_arguments, "--size: got " + text + ", need WxH, each 16 to 4096 pixels");
  truth.width = width;
  truth.height = height;
}

namespace {

void check_movers(const EvaluateNnaoOptions& options) {
  if (options.movers.empty()) {
    if (!options.clip.empty()) throw ToolError(exit_bad_arguments, "evaluate nnao: --clip needs --mover");
    return;
  }
  if (!options.temporal || !options.scenes.cameras.empty() || !options.scenes.radii.empty() ||
      !options.references.empty())
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --mover needs --temporal, and cannot be combined "
                    "with --camera, --radius or --references");
  for (std::size_t i = 0; i < options.movers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (options.movers[i].stem() == options.movers[j].stem())
        throw ToolError(exit_bad_arguments,
                        "evaluate nnao: --mover: two characters have the same name (got " +
                            options.movers[i].stem().string() + ")");
}

}  // namespace

void check_options(const EvaluateNnaoOptions& options) {
  const bool has_scenes = !options.scenes.files.empty() || options.scenes.thin || !options.views.empty();
  const int works = int(has_scenes) + int(!options.tune.empty()) + int(!options.frames.empty()) +
                    int(!options.movers.empty());
  if (works != 1)
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: nothing to do; give scenes (files, --views "
                    "or --thin), or --frame, --mover or --tune");
  if (!options.frames.empty() &&
      (!options.markdown.empty() || !options.scenes.cameras.empty() || !options.scenes.radii.empty()))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --frame cannot be combined with --markdown, "
                    "--camera or --radius, which are for scenes");
  check_movers(options);
  if (options.intensity != 1 && (!has_scenes || options.bent || options.temporal))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --intensity is only for the AO of single frames of scenes");
  if (options.temporal &&
      ((!has_scenes && options.movers.empty()) || options.bent || !options.methods.empty() ||
       !options.network.empty() || !options.ratios.empty() || (has_scenes && !options.images.empty())))
    throw ToolError(
        exit_bad_arguments,
        "evaluate nnao: --temporal needs scenes or --mover. It cannot be combined with --bent-normals, "
        "--methods, --network or --ratio. It can be combined with --images only if --mover is given");
  if (!options.views.empty() && !options.scenes.files.empty())
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --views already lists the scenes; leave out the files");
}

void add_options(Command command, EvaluateNnaoOptions& options) {
  command.add_input(
      "scene", options.scenes.files,
      "scenes in metres, y up, .glb or .gltf files; with more than one, the means are reported too");
  add_import_options(command, options.scenes.reading);
  command.add_input(
      "--views", options.views,
      "list of scenes and their cameras, such as docs/nnao_views.json, to measure instead of files");
  command.add_option("--folder", options.folder,
                     "folder with the scenes of --views, each as NAME.glb; default: the current folder");
  command
      .add_option("--sources", options.sources,
                  "measure only scenes from these sources in the list of --views, separated by commas")
      .delimiter(',');
  command.add_flag("--thin", options.scenes.thin,
                   "also measure a built-in scene of thin objects, called thin; means leave it out");
  command
      .add_input("--frame", options.frames,
                 "recorded frame, a file that nook_nnao_record wrote, to draw again instead of scenes and to "
                 "compare with the recorded AO and the oracle; you can repeat the option")
      .type_name("FILE.nook");
  std::vector<std::string> baselines{"all"};
  for (const Baseline baseline : all_baselines) baselines.push_back(baseline_name(baseline));
  command
      .add_option("--tune", options.tune,
                  "tune one baseline method, or all, on training scenes, and print the tuned parameters "
                  "instead of errors")
      .check(one_of(baselines));
  command
      .add_option("--camera", options.scenes.cameras,
                  "camera as [SCENE:]ox,oy,oz,tx,ty,tz,fov: eye, target and vertical field of view in "
                  "degrees; you can repeat the option. SCENE is the name of a file without .glb, or thin; "
                  "without SCENE, the camera is for every scene")
      .type_name("CAMERA");
  command
      .add_option("--cameras", options.placed_cameras,
                  "number of cameras to place in each scene for which you give none")
      .check(in_range(1, 1000))
      .capture_default_str();
  command
      .add_option("--radius", options.scenes.radii, "radius of the AO in metres, as [SCENE:]R; default 0.5")
      .type_name("RADIUS");
  command
      .add_option("--max-radius-px", options.max_radius_px,
                  "largest radius in pixels; every method shrinks a radius that covers more pixels. 0 means "
                  "half the height of the picture")
      .check(in_range(0.0, 1e4));
  command
      .add_option(
          "--intensity", options.intensity,
          "nook_nnao_frame_desc.intensity for Nook's filtered pass; other methods have no such setting")
      .check(in_range(0.0, 16.0))
      .capture_default_str();
  command
      .add_option_function(
          "--size",
          [&options](const std::string& text) {
            parse_size(text, options.truth);
            options.sized = true;
          },
          "size of a picture in pixels; default 640x360, or as in the list of --views")
      .type_name("WxH");
  command
      .add_option("--rays", options.truth.rays, "rays per pixel; default 128, or as in the list of --views")
      .check(in_range(1, 65536))
      .each([&options](const std::string&) { options.rays_given = true; });
  command.add_option(
      "--references", options.references,
      "folder that keeps ray-traced references; a reference that is already there is not traced again");
  std::vector<std::string> methods{"all", "nnao", half_name, twice_name, "nnao_paper", "nnao_file"};
  methods.insert(methods.end(), baselines.begin() + 1, baselines.end());
  for (const BaselineMethod& method : baseline_methods())
    if (method.shipped) methods.push_back(baseline_row(method));
  for (const Oracle oracle : all_oracles) methods.push_back(oracle_name(oracle));
  for (const std::string& name : frame_method_names()) methods.push_back(name);
  command
      .add_option(
          "--methods", options.methods,
          "measure only these methods, each as NAME or NAME:TAPS, separated by commas; default: all but the "
          "slow oracle and oracle_bitmask; with --frame: replayed, fast, default, best and oracle")
      .delimiter(',')
      .check([methods](const std::string& text) { return one_of(methods)(text.substr(0, text.find(':'))); });
  command
      .add_option("--ratio", options.ratios,
                  "also report the ratio between the errors of two methods, with its bounds; give "
                  "METHOD:TAPS,METHOD:TAPS; you can repeat the option")
      .type_name("RATIO");
  command.add_flag("--bent-normals", options.bent,
                   "measure bent normals and specular occlusion instead of AO, at every 16th pixel");
  command.add_flag(
      "--temporal", options.temporal,
      "measure AO that is averaged over the frames of a moving camera, instead of AO of single frames");
  command
      .add_option("--path-step", options.truth.path.step_px,
                  "with --temporal: number of pixels per frame by which a surface at the median depth moves; "
                  "0 means that the camera stands still")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command
      .add_input("--mover", options.movers,
                 "with --temporal: measure this character, which walks in front of a wall, instead of "
                 "scenes; a .glb or .gltf file with clips; you can repeat the option")
      .type_name("FILE");
  command.add_option("--clip", options.clip,
                     "clip that the character of --mover plays; default: the first clip with walk in its "
                     "name, or else the first clip");
  command.add_option("--walk-speed", options.walk_speed, "walking speed of --mover in metres per second")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command.add_flag("!--no-raw", options.raw,
                   "measure each method only with the blur that belongs to it, not without blur");
  command.add_input("--network", options.network,
                    "also measure this network, a file that `nook train nnao` wrote");
  command.add_option(
      "--images", options.images,
      "write a sheet of pictures for each view, and pictures of the networks, into this folder");
  command.add_option("--markdown", options.markdown, "write the tables of docs/lab/nnao.md to this file");
  add_common_options(command, options.common);
}

}  // namespace nook::lab
