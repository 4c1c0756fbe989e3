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
                    "evaluate nnao: give exactly one thing to measure: scenes (files, --views or --thin), "
                    "--frame, --mover or --tune");
  if (!options.frames.empty() &&
      (!options.markdown.empty() || !options.scenes.cameras.empty() || !options.scenes.radii.empty()))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --frame cannot be combined with --markdown, "
                    "--camera or --radius, which are for scenes");
  check_movers(options);
  if (options.intensity != 1 && (!has_scenes || options.bent || options.temporal))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --intensity works only for the AO of single frames of scenes");
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
  command.add_input("scene", options.scenes.files,
                    "scenes to measure: .glb or .gltf files in metres, y up. With several scenes, the report "
                    "also has the means over them");
  add_import_options(command, options.scenes.reading);
  command.add_input(
      "--views", options.views,
      "measure the scenes and cameras of this list instead of files, such as docs/nnao_views.json");
  command.add_option("--folder", options.folder,
                     "with --views: folder that contains the scenes of the list, each as NAME.glb. Default: "
                     "the current folder");
  command
      .add_option("--sources", options.sources,
                  "with --views: measure only the scenes of the list that come from these sources; separate "
                  "their names by commas")
      .delimiter(',');
  command.add_flag("--thin", options.scenes.thin,
                   "also measure the built-in scene `thin`, which has thin objects. The means over scenes do "
                   "not include it");
  command
      .add_input("--frame", options.frames,
                 "instead of scenes, measure this recorded frame, a file that nook_nnao_record wrote. Its AO "
                 "is drawn again, and compared with the recorded AO and with the exact AO of its depth "
                 "buffer (oracle). You can repeat the option")
      .type_name("FILE.nook");
  std::vector<std::string> baselines{"all"};
  for (const Baseline baseline : all_baselines) baselines.push_back(baseline_name(baseline));
  command
      .add_option("--tune", options.tune,
                  "instead of measuring, find the best parameters of this other method, or of all, on "
                  "training scenes, and print them")
      .check(one_of(baselines));
  command
      .add_option("--camera", options.scenes.cameras,
                  "add a camera, as [SCENE:]ox,oy,oz,tx,ty,tz,fov: eye and target in metres, and vertical "
                  "field of view in degrees. SCENE is the name of a file without .glb, or thin; without "
                  "SCENE, the camera is for every scene. You can repeat the option")
      .type_name("CAMERA");
  command
      .add_option("--cameras", options.placed_cameras,
                  "number of cameras to place in a scene for which you give no --camera")
      .check(in_range(1, 1000))
      .capture_default_str();
  command
      .add_option("--radius", options.scenes.radii,
                  "radius of AO in metres, as R for all scenes or SCENE:R for one. Default: 0.5")
      .type_name("RADIUS");
  command
      .add_option("--max-radius-px", options.max_radius_px,
                  "largest radius of AO in pixels. Every method shrinks a radius that covers more pixels. 0 "
                  "(default) means half the height of the picture")
      .check(in_range(0.0, 1e4));
  command
      .add_option("--intensity", options.intensity,
                  "intensity of AO in Nook's pass with its filter (nook_nnao_frame_desc.intensity). Other "
                  "methods have no such setting")
      .check(in_range(0.0, 16.0))
      .capture_default_str();
  command
      .add_option_function(
          "--size",
          [&options](const std::string& text) {
            parse_size(text, options.truth);
            options.sized = true;
          },
          "size of a picture in pixels. Default: 640x360, or the size in the list of --views")
      .type_name("WxH");
  command
      .add_option("--rays", options.truth.rays,
                  "number of rays per pixel of the ray-traced reference. Default: 128, or the number in the "
                  "list of --views")
      .check(in_range(1, 65536))
      .each([&options](const std::string&) { options.rays_given = true; });
  command.add_option(
      "--references", options.references,
      "keep the ray-traced references in this folder. A reference that is already there is not traced again");
  std::vector<std::string> methods{"all", "nnao", half_name, twice_name, "nnao_paper", "nnao_file"};
  methods.insert(methods.end(), baselines.begin() + 1, baselines.end());
  for (const BaselineMethod& method : baseline_methods())
    if (method.shipped) methods.push_back(baseline_row(method));
  for (const Oracle oracle : all_oracles) methods.push_back(oracle_name(oracle));
  for (const std::string& name : frame_method_names()) methods.push_back(name);
  command
      .add_option("--methods", options.methods,
                  "measure only these methods; separate them by commas. Each is NAME, or NAME:TAPS for a "
                  "number of taps. Default: all but oracle and oracle_bitmask, which are slow; with --frame: "
                  "replayed, fast, default, best and oracle")
      .delimiter(',')
      .check([methods](const std::string& text) { return one_of(methods)(text.substr(0, text.find(':'))); });
  command
      .add_option("--ratio", options.ratios,
                  "also report the error of the first method divided by the error of the second, with "
                  "bounds. Give METHOD:TAPS,METHOD:TAPS. You can repeat the option")
      .type_name("RATIO");
  command.add_flag("--bent-normals", options.bent,
                   "instead of AO, measure bent normals and specular occlusion, at every 16th pixel");
  command.add_flag(
      "--temporal", options.temporal,
      "instead of AO of single frames, measure AO that is averaged over the frames of a moving camera");
  command
      .add_option("--path-step", options.truth.path.step_px,
                  "with --temporal: speed of the camera, as the number of pixels per frame by which a "
                  "surface at the median depth moves. With 0, the camera stands still")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command
      .add_input("--mover", options.movers,
                 "with --temporal: instead of scenes, measure this character, which walks in front of a "
                 "wall. Give a .glb or .gltf file with clips. You can repeat the option")
      .type_name("FILE");
  command.add_option("--clip", options.clip,
                     "with --mover: clip that the character plays. Default: the first clip with walk in its "
                     "name, or the first clip if there is none");
  command
      .add_option("--walk-speed", options.walk_speed,
                  "with --mover: walking speed of the character in metres per second")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command.add_flag("!--no-raw", options.raw,
                   "measure each method only with its own blur. By default, each method is measured with and "
                   "without its blur");
  command.add_input(
      "--network", options.network,
      "also measure the screen-space pass with this network, a file that `nook train nnao` wrote");
  command.add_option(
      "--images", options.images,
      "write PNG files into this folder: a sheet of pictures for each view, and pictures of the networks");
  command.add_option("--markdown", options.markdown, "write the tables of docs/lab/nnao.md to this file");
  add_common_options(command, options.common);
}

}  // namespace nook::lab
