// `nook evaluate lods` measures the AO of meshes with less detail. Their AO comes from the bake of the full
// mesh.
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/character/character_report.h"
#include "bakers/measure/character/lod_error.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  PoseChoice poses;
  std::vector<double> shares{0.5, 0.25, 0.1};
  std::uint32_t rays = 256;
  std::size_t training_poses = 300;
};

Json row_of(double share, const LodRow& lod, const ErrorColumns& full) {
  const auto ratio = [](double error, double baseline) { return baseline > 0 ? error / baseline : 0; };
  Json row;
  row["share"] = share;
  row["triangles"] = lod.triangles;
  row["vertices"] = lod.vertices;
  const auto add = [&](const std::string& form, const ErrorColumns& error) {
    row["mse_visible" + form] = error.mse_visible;
    row["mse" + form] = error.mse;
    row["ratio_to_full_visible" + form] = ratio(error.mse_visible, full.mse_visible);
  };
  add("_refitted", lod.refitted.model);
  add("_resampled", lod.resampled.model);
  add("_nearest", lod.nearest.model);
  row["mse_visible_static"] = lod.refitted.static_bake.mse_visible;
  return row;
}

Json evaluate(const Options& options) {
  const BakedCharacter baked = read_evaluated_files(options.files, options.common);
  const std::optional<bake::Recipe> recipe = stored_recipe(baked);
  if (!recipe)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the model does not contain the recipe of the poses that it was fitted to; bake it again");
  PoseChoice fitted;
  fitted.training = true;
  fitted.most = options.training_poses;
  const std::vector<bake::Pose> training = choose_poses(baked.character, &*recipe, fitted).poses;
  const EvaluatedPoses measured = choose_poses(baked.character, &*recipe, options.poses);
  const std::uint64_t seed = evaluation_ray_seed(options.common.seed);
  platform::ProgressBar bar(options.common.quiet);
  const auto progress = [&](std::size_t done, std::size_t total) {
    bar.show("ray tracing", "poses", done, total);
    return !interrupted();
  };
  const bake::SkinnedMesh& mesh = baked.character.mesh;
  const ErrorColumns full =
      evaluate_character(mesh, baked.model, measured.poses, options.rays, seed, progress).model;
  Json report;
  report["character"] = options.files.character.stem().string();
  report["protocol"] = measured.protocol;
  report["poses"] = measured.poses.size();
  report["rays"] = options.rays;
  report["triangles"] = mesh.triangle.size();
  report["vertices"] = mesh.vertex_count();
  report["mse_visible"] = full.mse_visible;
  report["mse"] = full.mse;
  report["mse_area"] = full.mse_area;
  report["rows"] = Json::array();
  for (const double share : options.shares)
    report["rows"].push_back(
        row_of(share,
               measure_lod(simplified(mesh, share), baked.model, training,
                           {options.rays, options.common.seed}, measured.poses, options.rays, seed, progress),
               full));
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_lods(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "lods",
      "measure three ways to get AO on simplified copies of a character, against ray tracing.\nmeshoptimizer "
      "makes meshes with fewer triangles from the character. Each mesh is compared with its own ray-traced "
      "AO. The way called refitted fits the vertices of the new mesh, like `nook bake lod`. resampled "
      "interpolates the weights of the full mesh (nook_model_resample). nearest gives each vertex the AO of "
      "the nearest vertex of the full mesh.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  o.poses.samples_per_clip = 4;
  add_evaluated_files(command, o.files);
  command
      .add_option("--shares", o.shares,
                  "number of triangles of each simplified mesh, divided by the number in the full mesh; "
                  "separate the values by commas")
      .delimiter(',')
      .check(in_range(0.001, 1.0))
      .capture_default_str();
  command.add_option("--samples-per-clip", o.poses.samples_per_clip, "number of poses to take from each clip")
      .check(in_range(1, 100000))
      .capture_default_str();
  command
      .add_option("--max-poses", o.poses.most,
                  "measure at most this many of these poses, picked at even intervals. Default: all")
      .check(in_range(1, 10000000));
  command
      .add_option("--training-poses", o.training_poses,
                  "for refitted: number of poses that the vertices are fitted to")
      .check(in_range(8, 100000))
      .capture_default_str();
  command.add_option("--rays", o.rays, "number of rays per vertex and pose")
      .check(in_range(1, 65536))
      .capture_default_str();
  add_common_options(command, o.common);
  command.callback([options] {
    run_evaluation(options->common, {named_files(options->files), {}, {}},
                   [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
