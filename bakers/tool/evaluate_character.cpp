// `nook evaluate character` compares a model with ray tracing. It also measures the methods that a team would
// use instead of the model.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/character/character_pictures.h"
#include "bakers/measure/character/character_report.h"
#include "bakers/measure/character/motion_error.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_inputs.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/peers.h"
#include "platform/printable.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using namespace measure;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  PoseChoice poses;
  std::uint32_t rays = 256;
  bool is_motion = false;
  std::filesystem::path images;
  std::size_t image_count = 4;
};

std::optional<bake::Recipe> known_recipe(const BakedCharacter& baked, const Options& options) {
  const auto recipe = naming_file(options.files.model, [&] { return stored_recipe(baked); });
  if (recipe && bake::reads_other_content(*recipe, baked.character) && !options.common.quiet)
    std::fprintf(stderr,
                 "%s: the character file has changed since the bake, so the results compare the old model "
                 "with the new file\n",
                 platform::printable(options.files.model.string()).c_str());
  return recipe;
}

Json motion_row(const Options& options, const BakedCharacter& baked, const std::vector<std::string>& names) {
  constexpr std::size_t usual_frames = 480;
  std::vector<std::size_t> clips;
  for (const std::string& name : names) clips.push_back(bake::find_clip(baked.character, name));
  platform::ProgressBar bar(options.common.quiet);
  const MotionErrors errors = measure_motion(
      baked.character, baked.model, clips, options.poses.most ? options.poses.most : usual_frames,
      options.rays, evaluation_ray_seed(options.common.seed), [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing", "frames", done, total);
        return !interrupted();
      });
  return {{"character", options.files.character.stem().string()},
          {"frames", errors.frames},
          {"rays", options.rays},
          {"vertex_frames", errors.vertex_frames},
          {"largest_step", errors.largest_step},
          {"largest_step_truth", errors.largest_step_truth},
          {"largest_step_ratio",
           errors.largest_step_truth > 0 ? errors.largest_step / errors.largest_step_truth : 0},
          {"share_beyond", errors.share_beyond},
          {"largest_beyond", errors.largest_beyond},
          {"worst_clip", errors.worst_clip}};
}

Json evaluate(const Options& options, std::span<const CharacterPeer> peers) {
  const BakedCharacter baked = read_evaluated_files(options.files, options.common);
  require_clips(options.poses.clips, baked.character);
  const std::optional<bake::Recipe> recipe = known_recipe(baked, options);
  const EvaluatedPoses measured = choose_poses(baked.character, recipe ? &*recipe : nullptr, options.poses);

  if (options.is_motion)
    return {{"rows", Json::array({motion_row(options, baked, measured.clips)})},
            {"clips", measured.clips},
            {"seed", options.common.seed}};

  platform::ProgressBar bar(options.common.quiet);
  const auto stage = [&bar](const char* label) {
    return [&bar, label](std::size_t done, std::size_t total) {
      bar.show(label, "poses", done, total);
      return !interrupted();
    };
  };
  CharacterReport measured_report = measure_character(
      baked, recipe ? &*recipe : nullptr, measured,
      {options.files.character.stem().string(), options.rays, options.common.seed, peers}, stage);
  if (!options.images.empty())
    write_pictures(options.images, baked.character.mesh, baked.model, measured.poses, options.image_count,
                   measured_report.evaluation.vertex_rms, options.rays,
                   evaluation_ray_seed(options.common.seed));
  Json report;
  report["rows"] = Json::array({std::move(measured_report.row)});
  report["clips"] = measured.clips;
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_character(Command evaluate_command) {
  add_evaluate_character(evaluate_command, std::span<const measure::CharacterPeer>());
}

void add_evaluate_character(Command evaluate_command, std::span<const CharacterPeer> peers) {
  const Command command = evaluate_command.add_subcommand(
      "character",
      "measure the AO of a baked character against ray tracing.\nmse is the mean squared error of AO over "
      "all vertices and poses. mse_visible is the error over the vertices with a traced AO of 0.01 or more; "
      "visible_share is the share of these vertices. mse_area is the error weighted by the area around each "
      "vertex. mse_static is the error if AO is baked once, in the rest pose. mse_oracle is the error of the "
      "best AO that does not depend on the pose.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(command, o.files);
  command
      .add_option_function(
          "--poses", [&o](const std::string& name) { o.poses.training = name == "training"; },
          "which poses to measure: clips (default, poses of clips) or training (the poses that the model was "
          "fitted to)")
      .check(one_of({"clips", "training"}))
      .type_name("NAME");
  command
      .add_option("--clips", o.poses.clips,
                  "measure only these clips; separate their names by commas. Default: the clips that the "
                  "model was not fitted to, or all clips if it was fitted to all")
      .delimiter(',');
  command.add_option("--samples-per-clip", o.poses.samples_per_clip, "number of poses to take from each clip")
      .check(in_range(1, 100000))
      .capture_default_str();
  command
      .add_option("--max-poses", o.poses.most,
                  "measure at most this many of these poses, picked at even intervals. Default: all")
      .check(in_range(1, 10000000));
  command.add_option("--rays", o.rays, "number of rays per vertex and pose")
      .check(in_range(1, 65536))
      .capture_default_str();
  command.add_flag("--motion", o.is_motion,
                   "measure motion instead of single poses: how much AO changes from frame to frame at 60 "
                   "Hz, compared with ray tracing. The frames of a clip are consecutive. --max-poses limits "
                   "the frames of all clips together; its default is then 480. share_beyond is the share of "
                   "vertices and frames in which AO changes by 0.02 more than ray-traced AO does");
  command.add_option("--images", o.images,
                     "write PNG files into this folder that show the error of AO on the body");
  command.add_option("--image-count", o.image_count, "with --images: number of poses to draw")
      .check(in_range(1, 1000))
      .capture_default_str();
  add_common_options(command, o.common);
  command.callback([options, peers] {
    run_evaluation(options->common, {named_files(options->files), {}, options->images},
                   [&] { return evaluate(*options, peers); });
  });
}

}  // namespace nook::tool
