// nook evaluate casters: how much a lone neighbour darkens, by each form and by ray tracing.
#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/measure/character/report.h"
#include "bakers/tool/character/evaluated_files.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/interrupt.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  bake::CasterStudy study;
  std::size_t poses = 4;
};

Json evaluate(const Options& options) {
  const measure::BakedCharacter baked = read_evaluated_files(options.files);
  bake::CasterStudy study = options.study;
  study.seed = options.common.seed;
  platform::ProgressBar bar(options.common.quiet);
  const auto rows = bake::measure_casters(baked.character.mesh, baked.model,
                                          measure::caster_poses(baked.character, options.poses), study,
                                          [&](std::size_t done, std::size_t total) {
                                            bar.show("ray tracing neighbours", "pairs", done, total);
                                            return !interrupted();
                                          });
  Json report;
  report["rows"] = measure::caster_rows(rows);
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
  add_evaluated_files(*command, o.files);
  command->add_option("--rays", o.study.rays, "rays for each vertex")
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
    run_evaluation(options->common, {named_files(options->files), {}, {}},
                   [&] { return evaluate(*options); });
  });
}

}  // namespace nook::tool
