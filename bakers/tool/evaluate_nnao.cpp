// nook evaluate nnao: the screen-space pass and its baselines against ray tracing, on OpenGL without a
// display.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/nnao/bent_comparison.h"
#include "bakers/measure/nnao/comparison.h"
#include "bakers/measure/nnao/frame_comparison.h"
#include "bakers/measure/nnao/network_picture.h"
#include "bakers/measure/nnao/oracle_pass.h"
#include "bakers/measure/nnao/report.h"
#include "bakers/measure/nnao/scene_views.h"
#include "bakers/measure/nnao/sequence_comparison.h"
#include "bakers/measure/nnao/sheet.h"
#include "bakers/measure/nnao/tuning.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/input_file.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/evaluate_frames.h"
#include "bakers/tool/nnao/scenes.h"
#include "bakers/tool/nnao/views_file.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  TruthSettings truth;
  SceneWords scenes;
  std::filesystem::path views;                // a list of scenes with their cameras, instead of files
  std::filesystem::path folder;               // of the list's scenes
  std::vector<std::string> sources;           // of the list; empty: all
  std::vector<std::filesystem::path> frames;  // recorded ones, instead of scenes
  bool sized = false, rays_given = false;
  std::filesystem::path references, network, images, markdown;
  std::vector<std::string> methods;  // empty: all
  std::vector<std::string> ratios;   // METHOD:TAPS,METHOD:TAPS
  bool raw = true;
  bool bent = false;      // bent normals and specular occlusion in place of AO
  bool temporal = false;  // means over frames in place of single ones
  std::uint32_t placed_cameras = 3;
  float max_radius_px = 0;
  std::string tune;  // a baseline's name, or all; empty: no tuning
};

void parse_size(const std::string& text, TruthSettings& truth) {
  unsigned width = 0, height = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &used) != 2 || std::size_t(used) != text.size() ||
      width < 16 || height < 16 || width > 4096 || height > 4096)
    throw ToolError(exit_bad_arguments, "--size: got " + text + ", need WxH, each 16 to 4096 pixels");
  truth.width = width;
  truth.height = height;
}

// The columns of a picture after the scene and the truth.
struct Shown {
  const char* suffix;
  std::vector<std::pair<std::string, int>> methods;
};
const Shown sheets[] = {
    {"", {{"nnao", 9}, {"xegtao", 18}, {"gtao_bitmask", 16}, {"hbao", 64}}},
    {"_presets", {{half_name, 9}, {"nnao", 9}, {"nnao", 32}, {"gtao", 16}}},
    {"_shipped", {{"n8ao_shipped", 16}, {"s4ao_shipped", 12}, {"vtk_shipped", 32}, {"filament_shipped", 7}}}};

bool is_shown(const std::string& method, int taps) {
  for (const Shown& sheet : sheets)
    for (const auto& [shown_method, shown_taps] : sheet.methods)
      if (method == shown_method && taps == shown_taps) return true;
  return false;
}

void write_sheets(const std::filesystem::path& folder, std::span<const MeasuredView> views,
                  std::span<const std::string> names, std::span<const KeptImage> images) {
  for (const Shown& sheet : sheets)
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::vector<std::vector<float>> row;
      for (const auto& [method, taps] : sheet.methods)
        for (const KeptImage& image : images)
          if (image.view == v && image.method == method && image.taps == taps) row.push_back(image.ao);
      platform::write_image(folder / (names[v] + sheet.suffix + ".png"), make_sheet(views[v], row));
    }
}

std::unique_ptr<platform::Context> make_context() {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  return platform::create_context(request);
}

constexpr const char* thin_scene = "thin";  // the built-in scene's name

// The embedded network, and that of --network.
struct Networks {
  nook::nnao::Network embedded;
  std::vector<std::byte> file;  // empty: none
  nook::nnao::Network other;
};

Networks read_networks(const Options& options) {
  Networks networks;
  networks.embedded = nook::nnao::read_network(nook::nnao::default_network_file());
  if (options.network.empty()) return networks;
  networks.file = read_file(options.network);
  networks.other = naming_file(options.network, [&] { return nook::nnao::read_network(networks.file); });
  return networks;
}

// Returns the given network's name in tables; empty without one.
std::string other_name(const Networks& networks) {
  if (networks.file.empty()) return "";
  return networks.other.form == nook::nnao::NetworkForm::paper ? "nnao_paper" : "nnao_file";
}

void write_network_pictures(const std::filesystem::path& folder, const std::string& prefix,
                            const nook::nnao::Network& network, std::span<const MeasuredView> views,
                            std::span<const std::string> names) {
  platform::write_image(folder / (prefix + "_filters.png"), filter_picture(network));
  for (std::size_t v = 0; v < views.size(); ++v)
    platform::write_image(folder / (names[v] + "_" + prefix + "_units.png"), unit_picture(network, views[v]));
}

Comparison compare_views(const Options& options, platform::Context& context, const Networks& networks,
                         std::span<const MeasuredView> views) {
  ComparisonSettings settings;
  settings.other_network = networks.file;
  settings.other_name = other_name(networks);
  settings.methods = options.methods;
  settings.raw = options.raw;
  settings.request.max_radius_px =
      options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
  platform::ProgressBar bar(options.common.quiet);
  return compare(
      context, views, settings,
      [&](const std::string& method, int taps) { return !options.images.empty() && is_shown(method, taps); },
      [&](std::size_t done, std::size_t total) {
        bar.show("measuring", "methods", done, total);
        return !interrupted();
      });
}

std::vector<MeasuredView> traced_views(const SceneRequest& scene, const Options& options) {
  platform::ProgressBar bar(options.common.quiet);
  const std::string label = scene.name + ", ray tracing";
  return naming_file(scene.file, [&] {
    return trace_views(scene, options.truth, options.placed_cameras, options.references,
                       [&](std::size_t done, std::size_t total) {
                         bar.show(label, "views", done, total);
                         return !interrupted();
                       });
  });
}

// The names of the views' pictures: SCENE_CAMERA, or SCENE_NUMBER without the camera's name.
std::vector<std::string> picture_names(std::span<const MeasuredView> views) {
  std::vector<std::string> names;
  std::size_t number = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    number = v > 0 && views[v].scene == views[v - 1].scene ? number + 1 : 0;
    std::string name = views[v].scene;
    name += '_';
    name += views[v].camera.empty() ? std::to_string(number) : views[v].camera;
    names.push_back(name);
  }
  return names;
}

// The views of each source in their order.
std::vector<ViewGroup> group_views(std::span<const MeasuredView> views, bool has_thin) {
  std::vector<ViewGroup> groups;
  for (std::size_t v = 0; v < views.size(); ++v) {
    auto group = std::ranges::find(groups, views[v].source, &ViewGroup::name);
    if (group == groups.end())
      group = groups.insert(group, {views[v].source, {}, has_thin && views[v].source == thin_scene});
    group->views.push_back(v);
  }
  return groups;
}

// The scenes of the command line or of the list, and the ratios to report.
struct Work {
  std::vector<SceneRequest> scenes;
  std::vector<MethodRatio> ratios;
};

void keep_sources(std::vector<SceneRequest>& scenes, const std::vector<std::string>& sources) {
  for (const std::string& source : sources)
    if (std::ranges::find(scenes, source, &SceneRequest::source) == scenes.end())
      throw ToolError(exit_bad_arguments, "evaluate nnao: --sources: the list has no " + source);
  if (!sources.empty())
    std::erase_if(scenes, [&](const SceneRequest& scene) {
      return std::ranges::find(sources, scene.source) == sources.end();
    });
}

Work read_work(Options& options) {
  Work work;
  work.scenes = parse_scenes(options.scenes);
  if (!options.views.empty()) {
    ViewsFile file = read_views_file(options.views, options.folder);
    if (!file.size.empty() && !options.sized) parse_size(file.size, options.truth);
    if (file.rays > 0 && !options.rays_given) options.truth.rays = file.rays;
    keep_sources(file.scenes, options.sources);
    work.scenes.insert(work.scenes.begin(), file.scenes.begin(), file.scenes.end());
    work.ratios = std::move(file.ratios);
  }
  for (const std::string& text : options.ratios) work.ratios.push_back(parse_ratio(text));
  return work;
}

Json scene_summary(const ViewGroup& group, std::span<const MeasuredView> views) {
  double noise = 0;
  for (const std::size_t v : group.views) noise += views[v].noise / double(group.views.size());
  return {{"scene", group.name},
          {"views", group.views.size()},
          {"radius", views[group.views.front()].radius},
          {"noise_floor_mse", noise}};
}

void write_pictures(const Options& options, const Networks& networks, std::span<const MeasuredView> views,
                    std::span<const KeptImage> images) {
  const std::vector<std::string> names = picture_names(views);
  write_sheets(options.images, views, names, images);
  if (!options.views.empty()) return;  // a list has too many views for pictures of the networks
  write_network_pictures(options.images, "nnao", networks.embedded, views, names);
  if (!networks.file.empty()) write_network_pictures(options.images, "other", networks.other, views, names);
}

Json evaluate(Options& options) {
  const Work work = read_work(options);
  const Networks networks = read_networks(options);
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  const std::string other = other_name(networks);
  for (const std::string& method : options.methods)
    for (const std::string of_file : {"nnao_paper", "nnao_file"})
      if (method.substr(0, method.find(':')) == of_file && of_file != other)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: --network gives no " + method);
  for (const std::string& method : options.methods)
    for (const std::string& of_frames : frame_method_names())
      if (method.substr(0, method.find(':')) == of_frames)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: " + method + " is of --frame alone");
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  const auto context = make_context();
  std::vector<MeasuredView> views;
  for (const SceneRequest& scene : work.scenes)
    for (MeasuredView& view : traced_views(scene, options)) views.push_back(std::move(view));
  const Comparison comparison = compare_views(options, *context, networks, views);
  if (comparison.rows.empty())
    throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: none is measured with these taps");
  if (!options.images.empty()) write_pictures(options, networks, views, comparison.images);

  const std::string resolution =
      std::to_string(options.truth.width) + "x" + std::to_string(options.truth.height);
  const std::vector<ViewGroup> groups = group_views(views, options.scenes.thin);
  Json report, rows = Json::array(), borders = Json::array(), scenes = Json::array();
  for (const ViewGroup& group : groups) {
    for (const Json& row : nnao_rows(comparison, group, resolution, context->renderer())) rows.push_back(row);
    for (const Json& row : nnao_border_rows(comparison, group)) borders.push_back(row);
    scenes.push_back(scene_summary(group, views));
  }
  for (const Json& row : nnao_mean_rows(rows, comparison, groups)) rows.push_back(row);
  const Json ratios = nnao_ratio_rows(comparison, views, groups, work.ratios, options.common.seed);
  if (markdown) markdown->commit(nnao_markdown(rows, ratios));
  report["rows"] = std::move(rows);
  report["scenes"] = std::move(scenes);
  report["borders"] = std::move(borders);
  report["ratios"] = ratios;
  report["views"] = nnao_view_rows(comparison, views);
  report["rays"] = options.truth.rays;
  report["opengl"] = context->version();
  report["seed"] = options.common.seed;
  return report;
}

// Bent normals and specular occlusion in place of AO.
Json evaluate_bent(Options& options) {
  const Work work = read_work(options);
  options.truth.bent_stride = 4;
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  const auto context = make_context();
  std::vector<MeasuredView> views;
  for (const SceneRequest& scene : work.scenes)
    for (MeasuredView& view : traced_views(scene, options)) views.push_back(std::move(view));
  AoRequest request;
  request.max_radius_px =
      options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
  platform::ProgressBar bar(options.common.quiet);
  Json report;
  report["rows"] = bent_rows(*context, views, request, [&](std::size_t done, std::size_t total) {
    bar.show("measuring", "methods", done, total);
    return !interrupted();
  });
  if (markdown) markdown->commit(bent_markdown(report["rows"]));
  report["roughness"] = measured_roughness;
  report["rays"] = options.truth.rays;
  report["seed"] = options.common.seed;
  return report;
}

// Means over the frames of a moving camera in place of single frames.
Json evaluate_temporal(Options& options) {
  const Work work = read_work(options);
  options.truth.path.frames = sequence_frames;
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  const auto context = make_context();
  AoRequest request;
  request.max_radius_px =
      options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
  std::vector<SequenceView> measured;
  // Scene by scene: the frames of all take a gigabyte.
  for (const SceneRequest& scene : work.scenes) {
    const std::vector<MeasuredView> views = traced_views(scene, options);
    platform::ProgressBar bar(options.common.quiet);
    for (std::size_t v = 0; v < views.size(); ++v) {
      bar.show(scene.name + ", measuring", "views", v, views.size());
      if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
      measured.push_back(measure_sequence(*context, views[v], request));
    }
    bar.show(scene.name + ", measuring", "views", views.size(), views.size());
  }
  Json report = sequence_report(measured, options.common.seed);
  if (markdown) markdown->commit(sequence_markdown(report));
  report["step_px"] = options.truth.path.step_px;
  report["rays"] = options.truth.rays;
  report["opengl"] = context->version();
  report["seed"] = options.common.seed;
  return report;
}

Json tune(const Options& options) {
  platform::ProgressBar bar(options.common.quiet);
  const std::vector<MeasuredView> views =
      tuning_views(options.common.seed, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing", "views", done, total);
        return !interrupted();
      });
  const auto context = make_context();
  std::vector<BaselineMethod> methods;
  for (const BaselineMethod& method : baseline_methods())
    if (!method.shipped && (options.tune == "all" || options.tune == baseline_name(method.baseline)))
      methods.push_back(method);
  const std::vector<TunedBaseline> tuned =
      tune_baselines(*context, views, methods, [&](std::size_t done, std::size_t total) {
        bar.show("tuning", "methods", done, total);
        return !interrupted();
      });
  Json report;
  report["rows"] = Json::array();
  for (const TunedBaseline& t : tuned) {
    std::fputs(tuning_line(t.method).c_str(), stdout);
    for (const std::string& axis : t.at_edge)
      std::fprintf(stderr, "%s %d: the best %s is the last of its grid\n", baseline_name(t.method.baseline),
                   t.method.taps, axis.c_str());
    report["rows"].push_back({{"method", baseline_name(t.method.baseline)},
                              {"taps", t.method.taps},
                              {"radius_scale", t.method.tuning.radius_scale},
                              {"power", t.method.tuning.power},
                              {"shape", t.method.tuning.shape},
                              {"thin", t.method.tuning.thin},
                              {"equal_weights", t.method.tuning.equal_weights},
                              {"border", border_name(t.method.tuning.border)},
                              {"denoiser", denoiser_name(t.method.tuning.denoiser)},
                              {"at_edge", t.at_edge},
                              {"mse", t.mse}});
  }
  return report;
}

Json replay(const Options& options) {
  const Networks networks = read_networks(options);
  const auto context = make_context();
  return evaluate_frames(
      *context, {options.frames, options.methods, networks.file, options.images, options.common.quiet});
}

void run(Options& options) {
  const bool has_scenes = !options.scenes.files.empty() || options.scenes.thin || !options.views.empty();
  const int works = int(has_scenes) + int(!options.tune.empty()) + int(!options.frames.empty());
  if (works != 1)
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: need scenes (files, --views or --thin), or --frame, or else --tune");
  if (!options.frames.empty() &&
      (!options.markdown.empty() || !options.scenes.cameras.empty() || !options.scenes.radii.empty()))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --frame: --markdown, --camera and --radius are of scenes alone");
  if (options.temporal && (!has_scenes || options.bent || !options.methods.empty() ||
                           !options.network.empty() || !options.images.empty() || !options.ratios.empty()))
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --temporal: it needs scenes, and has no --bent-normals, --methods, "
                    "--network, --images and --ratio");
  if (!options.views.empty() && !options.scenes.files.empty())
    throw ToolError(exit_bad_arguments, "evaluate nnao: --views: its scenes take the place of files");
  options.truth.seed = options.common.seed;
  CommandFiles files{{{"--network", options.network}}, {{"--markdown", options.markdown}}, options.images};
  if (!options.views.empty()) files.inputs.push_back({"--views", options.views});
  for (const std::filesystem::path& scene : options.scenes.files) files.inputs.push_back({"a scene", scene});
  for (const std::filesystem::path& frame : options.frames) files.inputs.push_back({"--frame", frame});
  run_evaluation(options.common, files, [&] {
    if (!options.frames.empty()) return replay(options);
    if (!options.tune.empty()) return tune(options);
    if (options.temporal) return evaluate_temporal(options);
    return options.bent ? evaluate_bent(options) : evaluate(options);
  });
}

}  // namespace

void add_evaluate_nnao(CLI::App& evaluate_command) {
  CLI::App* command = evaluate_command.add_subcommand("nnao",
                                                      "the screen-space pass, and SSAO, SSAO+, HBAO, GTAO, "
                                                      "GTAO with a visibility bitmask, XeGTAO, and forms of "
                                                      "what N8AO, Godot, VTK, QGIS and Filament ship, "
                                                      "against ray tracing");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command->add_option("scene", o.scenes.files,
                      "scenes in metres, y up, .glb or .gltf; of several, the means are reported as well");
  add_linked_files_option(*command, o.scenes.linked);
  command->add_option("--views", o.views,
                      "a list of scenes with their cameras, such as docs/nnao_views.json, instead of files");
  command->add_option("--folder", o.folder,
                      "where the scenes of --views lie, each as NAME.glb; default: here");
  command->add_option("--sources", o.sources, "measure these sources of --views alone, separated by commas")
      ->delimiter(',');
  command->add_flag("--thin", o.scenes.thin,
                    "a built-in scene of thin things, called thin; it enters no mean");
  command
      ->add_option(
          "--frame", o.frames,
          "replay frames that nook_nnao_record wrote, instead of scenes: against the recorded AO and "
          "the oracle; any number of times")
      ->type_name("FILE.nook");
  std::vector<std::string> baselines{"all"};
  for (const Baseline baseline : all_baselines) baselines.push_back(baseline_name(baseline));
  command
      ->add_option("--tune", o.tune,
                   "tune one baseline, or all, on training scenes and print their table instead")
      ->check(CLI::IsMember(baselines));
  command
      ->add_option(
          "--camera", o.scenes.cameras,
          "eye, target and vertical field of view in degrees: [SCENE:]ox,oy,oz,tx,ty,tz,fov; any number "
          "of times. SCENE is a file's name without .glb, or thin; without it, of every scene")
      ->type_name("CAMERA");
  command->add_option("--cameras", o.placed_cameras, "how many to place where none is given")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--radius", o.scenes.radii, "of the AO, metres, 0.5 by default: [SCENE:]R")
      ->type_name("RADIUS");
  command
      ->add_option("--max-radius-px", o.max_radius_px,
                   "where the radius covers more pixels, every method shrinks it; 0: half the height")
      ->check(CLI::Range(0.0, 1e4));
  command
      ->add_option_function<std::string>(
          "--size",
          [&o](const std::string& text) {
            parse_size(text, o.truth);
            o.sized = true;
          },
          "pixels; 640x360, or what the list of --views has")
      ->type_name("WxH");
  command->add_option("--rays", o.truth.rays, "rays for each pixel; 128, or what the list of --views has")
      ->check(CLI::Range(1, 65536))
      ->each([&o](const std::string&) { o.rays_given = true; });
  command->add_option("--references", o.references,
                      "keep the ray-traced references in this folder, and take those that are there");
  std::vector<std::string> methods{"all", "nnao", half_name, twice_name, "nnao_paper", "nnao_file"};
  methods.insert(methods.end(), baselines.begin() + 1, baselines.end());
  for (const BaselineMethod& method : baseline_methods())
    if (method.shipped) methods.push_back(baseline_row(method));
  for (const Oracle oracle : all_oracles) methods.push_back(oracle_name(oracle));
  for (const std::string& name : frame_method_names()) methods.push_back(name);
  command
      ->add_option(
          "--methods", o.methods,
          "measure these alone, NAME or NAME:TAPS, separated by commas; default: all, which leaves out "
          "the slow oracle and oracle_bitmask; with --frame replayed, fast, default, best and oracle")
      ->delimiter(',')
      ->check([methods](const std::string& text) {
        return CLI::IsMember(methods)(text.substr(0, text.find(':')));
      });
  command
      ->add_option("--ratio", o.ratios,
                   "report the ratio of two methods' errors with its bounds, besides those of --views: "
                   "METHOD:TAPS,METHOD:TAPS; any number of times")
      ->type_name("RATIO");
  command->add_flag("--bent-normals", o.bent,
                    "measure bent normals and specular occlusion in place of AO, at every 16th pixel");
  command->add_flag("--temporal", o.temporal,
                    "measure means over the frames of a moving camera in place of single frames");
  command
      ->add_option("--path-step", o.truth.path.step_px,
                   "with --temporal: pixels by which surfaces at the median depth move in a frame; 0: the "
                   "camera stands still")
      ->check(CLI::Range(0.0, 100.0))
      ->capture_default_str();
  command->add_flag("!--no-raw", o.raw, "measure each method with its blur alone");
  command->add_option("--network", o.network,
                      "a file of `nook train nnao`, such as the paper's form, measured as well");
  command->add_option("--images", o.images,
                      "write sheets of each view and pictures of the networks into this folder");
  command->add_option("--markdown", o.markdown, "write the tables of docs/nnao.md to this file");
  add_common_options(*command, o.common);
  command->callback([options] { run(*options); });
}

}  // namespace nook::tool
