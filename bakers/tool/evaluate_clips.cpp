// `nook evaluate clips` compares baked clips and the live model with ray tracing.
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/measure/character/character_report.h"
#include "bakers/measure/character/clip_error.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"
#include "sdk/src/character/clip_set.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  std::filesystem::path clips;
  measure::ClipStudy study;
};

double ratio(double error, double baseline) {
  return baseline > 0 ? error / baseline : 0;
}

Json row_of(const measure::ClipErrorRow& measured) {
  Json row;
  row["at"] = measured.at;
  row["distance_m"] = measured.distance_m;
  row["poses"] = measured.poses;
  row["mse_visible"] = measured.clips.mse_visible;
  row["mse_visible_live"] = measured.live.mse_visible;
  row["ratio_to_live_visible"] = ratio(measured.clips.mse_visible, measured.live.mse_visible);
  row["mse"] = measured.clips.mse;
  row["mse_live"] = measured.live.mse;
  row["ratio_to_live"] = ratio(measured.clips.mse, measured.live.mse);
  row["mse_visible_unlinked"] = measured.unlinked.mse_visible;
  row["darkening"] = measured.darkening;
  row["darkening_live"] = measured.darkening_live;
  row["darkening_traced"] = measured.darkening_traced;
  row["visible_share"] = measured.visible_share;
  row["noise_floor_mse"] = measured.noise_floor_mse;
  return row;
}

Json evaluate(const Options& options) {
  const measure::BakedCharacter baked = read_evaluated_files(options.files, options.common);
  const std::vector<std::byte> bytes = read_file(options.clips);
  const ClipSet set = naming_file(options.clips, [&] {
    ClipSet read = read_clip_set(bytes);
    check_clip_model(read, baked.model);
    return read;
  });
  measure::ClipStudy study = options.study;
  study.seed = measure::evaluation_ray_seed(options.common.seed);
  platform::ProgressBar bar(options.common.quiet);
  const auto rows = measure::measure_clips(baked.character, baked.model, set, study,
                                           [&](std::size_t done, std::size_t total) {
                                             bar.show("ray tracing", "poses", done, total);
                                             return !interrupted();
                                           });
  const double values = double(set.frame_count) * double(set.ao.rows);
  Json report;
  report["character"] = options.files.character.stem().string();
  report["clips"] = set.clips.size();
  report["frames"] = set.frame_count;
  report["vertices"] = set.ao.rows;
  report["modes"] = set.ao.modes;
  report["pose_modes"] = set.pose.modes;
  report["rays"] = study.rays;
  report["file_bytes"] = bytes.size();
  report["bytes_per_frame_vertex"] = double(bytes.size()) / values;
  report["bytes_per_frame_vertex_with_model"] = double(bytes.size() + baked.model_bytes.size()) / values;
  report["rows"] = Json::array();
  for (const measure::ClipErrorRow& row : rows) report["rows"].push_back(row_of(row));
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_clips(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "clips",
      "measure baked clips against ray tracing.\nErrors are measured at the baked frames, half-way between "
      "frames, and beside one neighbour that plays the same clips. Each is compared with the error of the "
      "character's model in the same poses. mse_visible is the mean squared error of AO over the vertices "
      "with a traced AO of 0.01 or more.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(command, o.files);
  command.add_input("clips", o.clips, "the baked clips, a .nook file that `nook bake clips` wrote")
      .required();
  command.add_option("--rays", o.study.rays, "number of rays per vertex and pose")
      .check(in_range(1, 65536))
      .capture_default_str();
  command
      .add_option("--max-poses", o.study.max_poses,
                  "largest number of poses to measure at the frames, and again half-way between frames, "
                  "picked at even intervals")
      .check(in_range(1, 10000000))
      .capture_default_str();
  command
      .add_option("--pairs", o.study.max_pairs,
                  "largest number of poses to measure with a neighbour, at each distance")
      .check(in_range(1, 100000))
      .capture_default_str();
  command
      .add_option("--distances", o.study.distances_m,
                  "distances between the body and its neighbour in metres; separate them by commas. Default: "
                  "0.75,1.5")
      .delimiter(',')
      .check(in_range(0.01, 1000.0));
  add_common_options(command, o.common);
  command.callback([options] {
    std::vector<NamedFile> read = named_files(options->files);
    read.push_back({"the clips", options->clips});
    run_evaluation(options->common, {read, {}, {}}, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
