// nook evaluate character: a model against ray tracing, beside what a team would use instead.
#include "character/evaluate.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "character/linear_pose.h"
#include "character/model_file.h"
#include "character/pose_clusters.h"
#include "character/recipe.h"
#include "cli/character/baked_character.h"
#include "cli/character/evaluated_poses.h"
#include "cli/character/pictures.h"
#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/input_file.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"
#include "import/skinning.h"

namespace nook::cli {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

struct Options : EvaluationOptions {
  PoseChoice poses;
  std::uint32_t rays = 256;
  bool peers = false;
  std::filesystem::path images;
  std::size_t image_count = 4;
};

// The seed of the evaluation's rays must differ from the fit's.
std::uint64_t ray_seed(const Options& options) {
  return mix_bits(options.common.seed ^ 0x6576616c75617465ull);
}

class Tracing {
 public:
  explicit Tracing(bool quiet) : bar_(quiet) {}
  Progress showing(const char* label) {
    return [this, label](std::size_t done, std::size_t total) {
      bar_.show(label, "poses", done, total);
      return !interrupted();
    };
  }

 private:
  ProgressBar bar_;
};

std::optional<Recipe> recipe_of(const ImportedCharacter& character, const CharacterModel& model,
                                const Options& options) {
  if (model.recipe.empty()) return std::nullopt;
  const Recipe recipe =
      naming_file(options.model, [&] { return read_recipe(character, std::string_view(model.recipe)); });
  if (recipe.source_hash != character.source_hash && !options.common.quiet)
    std::fprintf(stderr, "%s: the character file has changed since the bake; the numbers mix old and new\n",
                 options.model.c_str());
  return recipe;
}

double ratio(double error, double baseline) {
  return baseline > 0 ? error / baseline : 0;
}

Json model_row(const Options& options, const EvaluatedPoses& measured, const ImportedCharacter& character,
               const CharacterModel& model, std::span<const std::byte> bytes, const CharacterEvaluation& e) {
  Json row;
  row["character"] = options.character.stem().string();
  row["protocol"] = measured.protocol;
  row["vertices"] = model.vertex_count();
  row["bones"] = character.mesh.bones.size();
  row["spheres"] = model.spheres.size();
  row["key_points"] = model.key_points.size();
  row["model_bytes"] = bytes.size();
  row["map_bytes"] = Container(bytes, character_kind).section("FMAP").remaining();
  row["poses"] = e.poses;
  row["rays"] = e.rays;
  row["noise_floor_mse"] = e.noise_floor_mse;
  row["visible_share"] = e.visible_share;
  row["mse_visible"] = e.model.mse_visible;
  row["mse_static_visible"] = e.static_bake.mse_visible;
  row["mse_oracle_visible"] = e.oracle.mse_visible;
  row["ratio_to_static_visible"] = ratio(e.model.mse_visible, e.static_bake.mse_visible);
  row["mse"] = e.model.mse;
  row["rmse"] = std::sqrt(e.model.mse);
  row["mse_area"] = e.model.mse_area;
  row["mse_body"] = e.model.mse_body;
  row["mse_hands"] = e.model.mse_hands;
  row["mse_static"] = e.static_bake.mse;
  row["mse_area_static"] = e.static_bake.mse_area;
  row["mse_oracle"] = e.oracle.mse;
  row["mse_area_oracle"] = e.oracle.mse_area;
  row["ratio_to_static"] = ratio(e.model.mse, e.static_bake.mse);
  row["ratio_to_static_area"] = ratio(e.model.mse_area, e.static_bake.mse_area);
  return row;
}

// Fits the peers to the model's own training poses and measures them on the same targets.
void add_peers(Json& row, const Options& options, const ImportedCharacter& character, const Recipe* recipe,
               std::span<const Pose> measured, const AoTargets& truth, Tracing& tracing) {
  const std::vector<Pose> training = recipe ? recipe_poses(character, *recipe) : std::vector<Pose>();
  if (training.empty())
    throw ToolError(exit_bad_arguments,
                    "--peers: the model holds no recipe from which its training poses can be made again");
  const SkinnedMesh& mesh = character.mesh;
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const AoTargets fitted = trace_character_ao(mesh, training, recipe->settings.rays, recipe->settings.seed,
                                              tracing.showing("ray tracing the peers' training poses"));
  const auto measure = [&](const char* name, const std::unique_ptr<PoseRegression>& peer) {
    const RegressionError error = measure_regression(*peer, measured, truth, area);
    row[std::string("mse_") + name] = error.mse;
    row[std::string("mse_") + name + "_visible"] = error.mse_visible;
    row[std::string("mse_area_") + name] = error.mse_area;
    row[std::string("bytes_") + name] = peer->model_bytes();
    row[std::string("tuned_") + name] = peer->description();
  };
  measure("linear_pose", fit_linear_pose(mesh, training, fitted));
  measure("pose_clusters", fit_pose_clusters(mesh, training, fitted, options.common.seed));
}

Json evaluate(const Options& options) {
  const BakedCharacter baked = read_baked_character(options);
  const ImportedCharacter& character = baked.character;
  const CharacterModel& model = baked.model;
  const std::optional<Recipe> recipe = recipe_of(character, model, options);
  const EvaluatedPoses measured = choose_poses(character, recipe ? &*recipe : nullptr, options.poses);

  Tracing tracing(options.common.quiet);
  const CharacterEvaluation evaluation = evaluate_character(
      character.mesh, model, measured.poses, options.rays, ray_seed(options), tracing.showing("ray tracing"));
  Json row = model_row(options, measured, character, model, baked.model_bytes, evaluation);
  if (options.peers)
    add_peers(row, options, character, recipe ? &*recipe : nullptr, measured.poses, evaluation.truth,
              tracing);
  if (!options.images.empty())
    write_pictures(options.images, character.mesh, model, measured.poses, options.image_count,
                   evaluation.vertex_rms, options.rays, ray_seed(options));
  Json report;
  report["rows"] = Json::array({std::move(row)});
  report["clips"] = measured.clips;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_character(CLI::App& evaluate_command) {
  CLI::App* command =
      evaluate_command.add_subcommand("character",
                                      "measure a baked character against ray tracing.\n"
                                      "mse is over all vertices and poses, mse_visible over those that ray "
                                      "tracing does not find black (AO of at least 0.01; visible_share is "
                                      "their share); mse_area weights vertices by "
                                      "area; mse_static is the AO baked in the rest pose, "
                                      "mse_oracle the best that any static bake could do");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(*command, o);
  command
      ->add_option_function<std::string>(
          "--poses", [&o](const std::string& name) { o.poses.training = name == "training"; },
          "clips (default: without --clips those that were not fitted, or all if all were), or training (the "
          "poses it was "
          "fitted to)")
      ->check(CLI::IsMember({"clips", "training"}))
      ->type_name("NAME");
  command->add_option("--clips", o.poses.clips, "measure only these clips")->delimiter(',');
  command->add_option("--samples-per-clip", o.poses.samples_per_clip, "poses of each clip")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--max-poses", o.poses.most, "measure at most so many poses, evenly picked")
      ->check(CLI::Range(1, 10000000));
  command->add_option("--rays", o.rays, "rays a vertex and pose")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_flag(
      "--peers", o.peers,
      "also fit a linear pose model (Kontkanen & Aila 2006) and pose clusters (Kirk & Arikan 2007) to the "
      "model's training poses, tuned by cross-validation, and measure them");
  command->add_option("--images", o.images, "draw the error on the body: PNG files in this directory");
  command->add_option("--image-count", o.image_count, "poses to draw")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_common_options(*command, o.common);
  command->callback([options] { run_evaluation(options->common, [&] { return evaluate(*options); }); });
}

}  // namespace nook::cli
