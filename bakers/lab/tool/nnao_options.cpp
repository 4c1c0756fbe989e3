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
    if (!options.clip.empty()) throw ToolError(exit_bad_arguments, "evaluate nnao: --clip: it needs --mover");
    return;
  }
  if (!options.temporal || !options.scenes.cameras.empty() || !options.scenes.radii.empty() ||
      !options.references.empty())
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --mover: it needs --temporal, and has no --camera, --radius and "
                    "--references");
  for (std::size_t i = 0; i < options.movers.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (options.movers[i].stem() == options.movers[j].stem())
        throw ToolError(exit_bad_arguments, "evaluate nnao: --mover: two characters have one name (got " +
                                                options.movers[i].stem().string() + ")");
}

}  // namespace

void check_options(const EvaluateNnaoOptions& options) {
  const bool has_scenes = !options.scenes.files.empty() || options.scenes.thin || !options.views.empty();
  const int works = int(has_scenes) + int(!options.tune.empty()) + int(!options.frames.empty()) +
                    int(!options.movers.empty());
  if (works != 1)
    throw ToolError(
        exit_bad_arguments,
        "evaluate nnao: need scenes (files, --views or --thin), or --frame, or --mover, or else --tune");
  if (!options.frames.empty() &&
      (!options.markdown.empty() || !options.scenes.cameras.empty() || !options.scenes.radii.empty()))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --frame: --markdown, --camera and --radius are of scenes alone");
  check_movers(options);
  if (options.intensity != 1 && (!has_scenes || options.bent || options.temporal))
    throw ToolError(exit_bad_arguments, "evaluate nnao: --intensity: it is of AO of single frames of scenes");
  if (options.temporal &&
      ((!has_scenes && options.movers.empty()) || options.bent || !options.methods.empty() ||
       !options.network.empty() || !options.ratios.empty() || (has_scenes && !options.images.empty())))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --temporal: it needs scenes or --mover, and has no --bent-normals, "
                    "--methods, --network and --ratio, and --images with --mover alone");
  if (!options.views.empty() && !options.scenes.files.empty())
    throw ToolError(exit_bad_arguments, "evaluate nnao: --views: its scenes take the place of files");
}

void add_options(Command command, EvaluateNnaoOptions& options) {
  command.add_option("scene", options.scenes.files,
                     "scenes in metres, y up, .glb or .gltf; of several, the means are reported as well");
  add_import_options(command, options.scenes.reading);
  command.add_option("--views", options.views,
                     "a list of scenes with their cameras, such as docs/nnao_views.json, instead of files");
  command.add_option("--folder", options.folder,
                     "where the scenes of --views lie, each as NAME.glb; default: here");
  command
      .add_option("--sources", options.sources, "measure these sources of --views alone, separated by commas")
      .delimiter(',');
  command.add_flag("--thin", options.scenes.thin,
                   "a built-in scene of thin things, called thin; it enters no mean");
  command
      .add_option("--frame", options.frames,
                  "replay frames that nook_nnao_record wrote, instead of scenes: against the recorded AO and "
                  "the oracle; any number of times")
      .type_name("FILE.nook");
  std::vector<std::string> baselines{"all"};
  for (const Baseline baseline : all_baselines) baselines.push_back(baseline_name(baseline));
  command
      .add_option("--tune", options.tune,
                  "tune one baseline, or all, on training scenes and print their table instead")
      .check(one_of(baselines));
  command
      .add_option(
          "--camera", options.scenes.cameras,
          "eye, target and vertical field of view in degrees: [SCENE:]ox,oy,oz,tx,ty,tz,fov; any number "
          "of times. SCENE is a file's name without .glb, or thin; without it, of every scene")
      .type_name("CAMERA");
  command.add_option("--cameras", options.placed_cameras, "how many to place where none is given")
      .check(in_range(1, 1000))
      .capture_default_str();
  command.add_option("--radius", options.scenes.radii, "of the AO, metres, 0.5 by default: [SCENE:]R")
      .type_name("RADIUS");
  command
      .add_option("--max-radius-px", options.max_radius_px,
                  "where the radius covers more pixels, every method shrinks it; 0: half the height")
      .check(in_range(0.0, 1e4));
  command
      .add_option(
          "--intensity", options.intensity,
          "nook_nnao_frame_desc.intensity of the library's pass with its filter; the others have none")
      .check(in_range(0.0, 16.0))
      .capture_default_str();
  command
      .add_option_function(
          "--size",
          [&options](const std::string& text) {
            parse_size(text, options.truth);
            options.sized = true;
          },
          "pixels; 640x360, or what the list of --views has")
      .type_name("WxH");
  command
      .add_option("--rays", options.truth.rays, "rays for each pixel; 128, or what the list of --views has")
      .check(in_range(1, 65536))
      .each([&options](const std::string&) { options.rays_given = true; });
  command.add_option("--references", options.references,
                     "keep the ray-traced references in this folder, and take those that are there");
  std::vector<std::string> methods{"all", "nnao", half_name, twice_name, "nnao_paper", "nnao_file"};
  methods.insert(methods.end(), baselines.begin() + 1, baselines.end());
  for (const BaselineMethod& method : baseline_methods())
    if (method.shipped) methods.push_back(baseline_row(method));
  for (const Oracle oracle : all_oracles) methods.push_back(oracle_name(oracle));
  for (const std::string& name : frame_method_names()) methods.push_back(name);
  command
      .add_option(
          "--methods", options.methods,
          "measure these alone, NAME or NAME:TAPS, separated by commas; default: all, which leaves out "
          "the slow oracle and oracle_bitmask; with --frame replayed, fast, default, best and oracle")
      .delimiter(',')
      .check([methods](const std::string& text) { return one_of(methods)(text.substr(0, text.find(':'))); });
  command
      .add_option("--ratio", options.ratios,
                  "report the ratio of two methods' errors with its bounds, besides those of --views: "
                  "METHOD:TAPS,METHOD:TAPS; any number of times")
      .type_name("RATIO");
  command.add_flag("--bent-normals", options.bent,
                   "measure bent normals and specular occlusion in place of AO, at every 16th pixel");
  command.add_flag("--temporal", options.temporal,
                   "measure means over the frames of a moving camera in place of single frames");
  command
      .add_option("--path-step", options.truth.path.step_px,
                  "with --temporal: pixels by which surfaces at the median depth move in a frame; 0: the "
                  "camera stands still")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command
      .add_option("--mover", options.movers,
                  "with --temporal, instead of scenes: a character that walks before a wall, .glb or .gltf "
                  "with clips; any number of times")
      .type_name("FILE");
  command.add_option("--clip", options.clip,
                     "the clip of --mover; default: the first whose name has walk in it, or the first");
  command.add_option("--walk-speed", options.walk_speed, "of --mover along its way, metres a second")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command.add_flag("!--no-raw", options.raw, "measure each method with its blur alone");
  command.add_option("--network", options.network,
                     "a file of `nook train nnao`, such as the paper's form, measured as well");
  command.add_option("--images", options.images,
                     "write sheets of each view and pictures of the networks into this folder");
  command.add_option("--markdown", options.markdown, "write the tables of docs/nnao.md to this file");
  add_common_options(command, options.common);
}

}  // namespace nook::lab
