// nook evaluate casters: how much a lone neighbour darkens, by each form and by ray tracing.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "character/casters.h"
#include "character/pose_sets.h"
#include "cli/character/baked_character.h"
#include "cli/commands.h"
#include "cli/evaluation.h"
#include "cli/interrupt.h"
#include "cli/progress_bar.h"

namespace nook::cli {
namespace {

using namespace bake;
using Json = nlohmann::ordered_json;

struct Options : EvaluationOptions {
  CasterStudy study;
  std::size_t poses = 4;
};

Json evaluate(const Options& options) {
  const BakedCharacter baked = read_baked_character(options);
  const ImportedCharacter& character = baked.character;
  // Poses spread over the motion clips; the rest pose where there are none.
  const std::vector<std::size_t> clips = motion_clips(character);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < options.poses && !clips.empty(); ++i) {
    const std::size_t clip = clips[i * clips.size() / options.poses];
    poses.push_back(clip_poses(character, {&clip, 1}, 1).front());
  }
  if (poses.empty()) poses.push_back(rest_pose(character));
  CasterStudy study = options.study;
  study.seed = options.common.seed;
  ProgressBar bar(options.common.quiet);
  const std::vector<CasterRow> rows =
      measure_casters(character.mesh, baked.model, poses, study, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing neighbours", "pairs", done, total);
        return !interrupted();
      });
  Json report;
  report["rows"] = Json::array();
  for (const CasterRow& r : rows)
    report["rows"].push_back({{"distance_m", r.distance_m},
                              {"form", r.form},
                              {"darkening", r.darkening},
                              {"darkening_traced", r.darkening_traced},
                              {"ratio", r.darkening_traced > 0 ? r.darkening / r.darkening_traced : 0}});
  report["seed"] = options.common.seed;
  return report;
}

}  // namespace

void add_evaluate_casters(CLI::App& evaluate_command) {
  CLI::App* command =
      evaluate_command.add_subcommand("casters",
                                      "a lone neighbour at 1, 2, 3, 5 and 10 m: mean darkening of the body "
                                      "by each form and by ray tracing, over several "
                                      "bearings and poses");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(*command, o);
  command->add_option("--rays", o.study.rays, "rays a vertex")
      ->check(CLI::Range(1, 65536))
      ->capture_default_str();
  command->add_option("--bearings", o.study.bearings, "directions of the neighbour")
      ->check(CLI::Range(1, 360))
      ->capture_default_str();
  command->add_option("--poses", o.poses, "poses, spread over the clips")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_common_options(*command, o.common);
  command->callback([options] {
    run_evaluation(options->common, {evaluated_files(*options), {}, {}}, [&] { return evaluate(*options); });
  });
}

}  // namespace nook::cli
