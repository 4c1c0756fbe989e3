// nook evaluate nnao: the screen-space pass and its peers against ray tracing, on OpenGL without a display.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/nnao/comparison.h"
#include "cli/nnao/sheet.h"
#include "cli/nnao/tuning.h"
#include "cli/progress_bar.h"
#include "import/static_scene.h"
#include "nnao/thin_scene.h"

namespace nook::cli {
namespace {

using namespace bake::nnao;
using Json = nlohmann::ordered_json;

constexpr float degree = 0.017453293f;  // radians

struct GivenCamera {
  Vec3 eye, target;
  float fov = 0;  // vertical, radians
};

struct Options {
  CommonOptions common;
  TruthSettings truth;
  std::filesystem::path scene, network, images;
  std::vector<GivenCamera> cameras;
  std::uint32_t placed_cameras = 3;
  float max_radius_px = 0;
  bool thin = false;
  std::string tune;  // a peer's name, or all; empty: no tuning
};

GivenCamera parse_camera(const std::string& text) {
  float v[7];
  int used = 0;
  const int count =
      std::sscanf(text.c_str(), "%f,%f,%f,%f,%f,%f,%f%n", v, v + 1, v + 2, v + 3, v + 4, v + 5, v + 6, &used);
  bool good = count == 7 && std::size_t(used) == text.size();
  for (int i = 0; good && i < 7; ++i) good = std::isfinite(v[i]);
  const Vec3 eye{v[0], v[1], v[2]}, target{v[3], v[4], v[5]};
  if (!good || !(v[6] >= 1 && v[6] <= 170) || eye == target)
    throw ToolError(exit_bad_arguments, "--camera: got " + text +
                                            ", need ox,oy,oz,tx,ty,tz,fov: seven numbers, the eye apart from "
                                            "the target, fov 1 to 170 degrees");
  return {eye, target, v[6] * degree};
}

void parse_size(const std::string& text, TruthSettings& truth) {
  unsigned width = 0, height = 0;
  int used = 0;
  if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &used) != 2 || std::size_t(used) != text.size() ||
      width < 16 || height < 16 || width > 4096 || height > 4096)
    throw ToolError(exit_bad_arguments, "--size: got " + text + ", need WxH, each 16 to 4096 pixels");
  truth.width = width;
  truth.height = height;
}

TrainingScene read_scene(const Options& options) {
  if (options.thin) return make_thin_scene(options.common.seed);
  bake::StaticScene scene =
      naming_file(options.scene, [&] { return bake::import_static_scene(options.scene); });
  return scene_to_look_at({std::move(scene.position), std::move(scene.triangle)});
}

std::vector<MeasuredView> trace_views(const Options& options, const std::string& name) {
  const TrainingScene scene = read_scene(options);
  const bake::RayScene rays(scene.soup);
  std::vector<Camera> cameras;
  const TruthSettings& t = options.truth;
  for (const GivenCamera& c : options.cameras)
    cameras.push_back(look_at(c.eye, c.target, 0, c.fov, t.width, t.height));
  for (std::uint32_t i = 0; options.cameras.empty() && i < options.placed_cameras; ++i) {
    Random random(bake::mix_bits(t.seed) + i);
    cameras.push_back(place_camera(rays, scene, random, t.width, t.height));
  }
  ProgressBar bar(options.common.quiet);
  std::vector<MeasuredView> views;
  for (const Camera& camera : cameras) {
    bar.show("ray tracing", "views", views.size(), cameras.size());
    if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing");
    views.push_back(measure_view(rays, name, camera, t));
  }
  bar.show("ray tracing", "views", views.size(), cameras.size());
  return views;
}

// What a sheet shows after the scene and the truth.
constexpr std::pair<const char*, int> shown[] = {
    {"nnao", 64}, {"hbao", 64}, {"gtao_bitmask", 16}, {"ssao+", 16}};

void write_sheets(const Options& options, const std::string& name, std::span<const MeasuredView> views,
                  std::span<const KeptImage> images) {
  std::filesystem::create_directories(options.images);
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::vector<std::vector<float>> row;
    for (const auto& [method, taps] : shown)
      for (const KeptImage& image : images)
        if (image.view == v && image.method == method && image.taps == taps) row.push_back(image.ao);
    platform::write_image(options.images / (name + "_" + std::to_string(v) + ".png"),
                          make_sheet(views[v], row));
  }
}

Json json_rows(const Comparison& comparison, const std::string& scene, const std::string& resolution,
               const std::string& gpu) {
  Json rows = Json::array();
  for (const ComparisonRow& r : comparison.rows) {
    double reference = r.ms;
    for (const ComparisonRow& other : comparison.rows)
      if (other.method == "nnao" && other.taps == 64 && other.blurred == r.blurred) reference = other.ms;
    rows.push_back({{"method", r.method},
                    {"taps", r.taps},
                    {"blurred", r.blurred},
                    {"scene", scene},
                    {"resolution", resolution},
                    {"gpu", gpu},
                    {"mse", r.mse},
                    {"rmse", std::sqrt(r.mse)},
                    {"ssim", r.ssim},
                    {"r", r.correlation},
                    {"flicker", r.flicker},
                    {"fetches", r.fetches},
                    {"ms", r.ms},
                    {"ratio_to_nnao", r.ms / reference}});
  }
  return rows;
}

std::unique_ptr<platform::Context> make_context() {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  return platform::create_context(request);
}

Json evaluate(const Options& options) {
  const std::string name = options.thin ? "thin" : options.scene.stem().string();
  ComparisonSettings settings;
  if (!options.network.empty()) settings.paper_network = read_file(options.network);
  settings.request.max_radius_px =
      options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
  const std::vector<MeasuredView> views = trace_views(options, name);
  const auto context = make_context();
  ProgressBar bar(options.common.quiet);
  const Comparison comparison = compare(
      *context, views, settings,
      [&](const std::string& method, int taps) {
        for (const auto& [shown_method, shown_taps] : shown)
          if (method == shown_method && taps == shown_taps) return !options.images.empty();
        return false;
      },
      [&](std::size_t done, std::size_t total) {
        bar.show("measuring", "methods", done, total);
        return !interrupted();
      });
  if (!options.images.empty()) write_sheets(options, name, views, comparison.images);
  double noise = 0;
  for (const MeasuredView& view : views) noise += view.noise / double(views.size());
  const std::string resolution =
      std::to_string(options.truth.width) + "x" + std::to_string(options.truth.height);
  Json report;
  report["rows"] = json_rows(comparison, name, resolution, context->renderer());
  report["views"] = views.size();
  report["radius"] = options.truth.radius;
  report["max_radius_px"] = settings.request.max_radius_px;
  report["rays"] = options.truth.rays;
  report["noise_floor_mse"] = noise;
  report["opengl"] = context->version();
  report["seed"] = options.common.seed;
  return report;
}

Json tune(const Options& options) {
  ProgressBar bar(options.common.quiet);
  const std::vector<MeasuredView> views =
      tuning_views(options.common.seed, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing", "views", done, total);
        return !interrupted();
      });
  const auto context = make_context();
  std::vector<PeerMethod> methods;
  for (const PeerMethod& method : peer_methods())
    if (options.tune == "all" || options.tune == peer_name(method.peer)) methods.push_back(method);
  const std::vector<TunedPeer> tuned =
      tune_peers(*context, views, methods, [&](std::size_t done, std::size_t total) {
        bar.show("tuning", "methods", done, total);
        return !interrupted();
      });
  Json report;
  report["rows"] = Json::array();
  for (const TunedPeer& t : tuned) {
    std::fputs(tuning_line(t.method).c_str(), stdout);
    report["rows"].push_back({{"method", peer_name(t.method.peer)},
                              {"taps", t.method.taps},
                              {"radius_scale", t.method.tuning.radius_scale},
                              {"power", t.method.tuning.power},
                              {"shape", t.method.tuning.shape},
                              {"equal_weights", t.method.tuning.equal_weights},
                              {"mse", t.mse}});
  }
  return report;
}

void run(Options& options) {
  if (int(!options.scene.empty()) + int(options.thin) + int(!options.tune.empty()) != 1)
    throw ToolError(exit_bad_arguments, "evaluate nnao: need one of SCENE, --thin and --tune");
  options.truth.seed = options.common.seed;
  run_evaluation(options.common, [&] { return !options.tune.empty() ? tune(options) : evaluate(options); });
}

}  // namespace

void add_evaluate_nnao(CLI::App& evaluate_command) {
  CLI::App* command = evaluate_command.add_subcommand(
      "nnao",
      "the screen-space pass, and SSAO, SSAO+, HBAO, GTAO and GTAO with a visibility bitmask, against ray "
      "tracing");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command->add_option("scene", o.scene, "a scene in metres, y up, .glb or .gltf");
  command->add_flag("--thin", o.thin, "a built-in scene of thin things instead");
  std::vector<std::string> peers{"all"};
  for (const Peer peer : all_peers) peers.push_back(peer_name(peer));
  command
      ->add_option("--tune", o.tune,
                   "tune one peer, or all, on training scenes and print their table instead")
      ->check(CLI::IsMember(peers));
  command
      ->add_option_function<std::vector<std::string>>(
          "--camera",
          [&o](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) o.cameras.push_back(parse_camera(text));
          },
          "eye, target and vertical field of view in degrees: ox,oy,oz,tx,ty,tz,fov; any number of times")
      ->type_name("CAMERA");
  command->add_option("--cameras", o.placed_cameras, "how many to place where none is given")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--radius", o.truth.radius, "of the AO, metres")
      ->check(CLI::Range(1e-3, 1e3))
      ->capture_default_str();
  command
      ->add_option("--max-radius-px", o.max_radius_px,
                   "where the radius covers more pixels, every method shrinks it; 0: half the height")
      ->check(CLI::Range(0.0, 1e4));
  command
      ->add_option_function<std::string>(
          "--size", [&o](const std::string& text) { parse_size(text, o.truth); }, "pixels; 640x360")
      ->type_name("WxH");
  command->add_option("--rays", o.truth.rays, "rays a pixel")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--network", o.network, "a file of `nook train nnao --form paper`, measured as well");
  command->add_option("--images", o.images, "write a sheet of each view into this folder");
  add_common_options(*command, o.common);
  command->callback([options] { run(*options); });
}

}  // namespace nook::cli
