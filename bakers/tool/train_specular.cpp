// `nook train specular` fits the specular occlusion of the screen-space pass and writes its weights as a
// header.
#include <tbb/task_arena.h>

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/job/nnao_training.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/table.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path output;
  bake::nnao::SpecularFitSettings fit;
};

void run_in_arena(const Options& options) {
  const platform::FileEvents events = file_events(options.common.quiet);
  platform::OutputFile output(options.output, events);
  std::optional<platform::OutputFile> report_file;
  if (!options.common.report.empty()) report_file.emplace(options.common.report, events);
  platform::ProgressBar bar(options.common.quiet);
  const bake::SpecularTraining trained =
      bake::train_specular(options.fit, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing", "scenes", done, total);
        return !interrupted();
      });
  output.commit(trained.header);
  if (report_file) {
    const Json report = {{"training_points", trained.training_points},
                         {"validation_points", trained.validation_points},
                         {"mse", trained.error.fitted},
                         {"mse_lagarde", trained.error.lagarde}};
    report_file->commit(report.dump(2) + "\n");
  }
  char line[160];
  std::snprintf(line, sizeof line,
                "mse %.5f; Lagarde's formula from the same AO: mse %.5f; ratio of the two: %.3f\n",
                trained.error.fitted, trained.error.lagarde, trained.error.fitted / trained.error.lagarde);
  print_table(options.common, line, true);
}

void run(Options& options) {
  require_distinct_files({{}, {{"-o", options.output}, {"--report", options.common.report}}, {}});
  options.fit.seed = options.fit.data.seed = options.common.seed;
  tbb::task_arena arena(options.common.threads == 0 ? tbb::task_arena::automatic
                                                    : int(options.common.threads));
  arena.execute([&] { run_in_arena(options); });
}

}  // namespace

void add_train_specular(Command train) {
  const Command command = train.add_subcommand(
      "specular",
      "fit the formula for the specular occlusion of the screen-space pass to ray tracing.\nThe formula "
      "computes specular occlusion from AO and bent normals. Its numbers are fitted on procedural scenes.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command
      .add_option("-o,--output", o.output,
                  "write the numbers to this C++ header, such as shaders/nnao/specular_numbers.h")
      .required();
  command
      .add_option("--scenes", o.fit.data.scenes,
                  "number of procedural scenes. A sixth of them is used only for validation. Default: 192")
      .check(in_range(48, 100000));
  command
      .add_option("--views", o.fit.data.views, "number of camera views, of all scenes together. Default: 960")
      .check(in_range(48, 1000000));
  command.add_option("--points", o.fit.data.points_per_view, "number of points in each view. Default: 300")
      .check(in_range(1, 100000));
  command.add_option("--rays", o.fit.rays, "number of rays per reflection. Default: 64")
      .check(in_range(1, 65536));
  command.add_option("--steps", o.fit.steps, "number of optimisation steps of the fit. Default: 40000")
      .check(in_range(1, 1000000));
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
