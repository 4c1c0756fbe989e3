// `nook train nnao` makes the training set, trains a screen-space network and prints its validation error.
#include <tbb/task_arena.h>

#include <cstdio>
#include <map>
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
#include "platform/printable.h"
#include "platform/progress_bar.h"
#include "platform/stopwatch.h"

namespace nook::tool {
namespace {

using namespace nook::bake::nnao;
using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  std::filesystem::path output;
  double time_limit_s = 0;  // 0: none
  DatasetSettings data;
  TrainingSettings training;

  // Path of the checkpoint. Empty if the output is a device or a pipe, because then no checkpoint is kept.
  std::string resume;
};

TrainingState starting_state(const Options& options, const Dataset& data, const std::string& recipe) {
  if (options.resume.empty() || !std::filesystem::exists(options.resume))
    return start_training(data, options.training);
  const auto state = naming_file(options.resume, [&] {
    return read_checkpoint(read_file(options.resume), recipe, options.training.form);
  });
  if (!options.common.quiet)
    std::fprintf(stderr, "%s: continuing after %u of %u epochs\n",
                 platform::printable(options.resume).c_str(), state.epochs_done, options.training.epochs);
  return state;
}

Network train_with_progress(const Options& options, const Dataset& data, const std::string& recipe) {
  TrainingState state = starting_state(options, data, recipe);
  platform::ProgressBar bar(options.common.quiet);
  // Each new label starts a new line of the progress bar, so there is one line per tenth of the epochs.
  const std::uint32_t tenth = std::max(1u, options.training.epochs / 10);
  std::string label = "training";
  std::uint32_t labelled = 0;
  const platform::Stopwatch watch;
  const auto show = [&](const TrainingProgress& now) {
    if (now.validation_mse > 0 && now.epoch / tenth != labelled) {
      labelled = now.epoch / tenth;
      char text[80];
      std::snprintf(text, sizeof text, "training, validation mse %.5f", now.validation_mse);
      label = text;
    }
    bar.show(label, "steps", now.steps_done, now.steps);
    const bool in_time = options.time_limit_s == 0 || watch.seconds() < options.time_limit_s;
    return in_time && !interrupted();
  };
  return train(data, options.training, state, show, [&](const TrainingState& s) {
    if (!options.resume.empty()) platform::OutputFile(options.resume).commit(write_checkpoint(s, recipe));
  });
}

void run_in_arena(Options& options) {
  const platform::FileEvents events = file_events(options.common.quiet);
  platform::OutputFile output(options.output, events);
  if (output.is_regular()) options.resume = options.output.string() + ".resume";
  std::optional<platform::OutputFile> report_file;
  if (!options.common.report.empty()) report_file.emplace(options.common.report, events);
  const std::string recipe = bake::network_recipe(options.data, options.training);
  platform::Stopwatch watch;
  const Dataset data = [&] {
    platform::ProgressBar bar(options.common.quiet);
    return make_dataset(options.data, [&](std::size_t done, std::size_t total) {
      bar.show("ray tracing", "scenes", done, total);
      return !interrupted();
    });
  }();
  const double seconds_data = watch.lap_seconds();
  Network network = train_with_progress(options, data, recipe);
  const double seconds_training = watch.seconds();
  network.recipe = recipe;
  const std::vector<std::byte> file = nook::nnao::write_network(network);
  const Json rows = bake::validation_rows(network, data);
  output.commit(file);
  std::error_code gone;
  if (!options.resume.empty()) std::filesystem::remove(options.resume, gone);
  if (report_file) {
    Json report = {{"rows", rows},
                   {"recipe", Json::parse(recipe)},
                   {"training_points", data.training.size()},
                   {"validation_points", data.validation.size()},
                   {"seconds_data", seconds_data},
                   {"seconds_training", seconds_training},
                   {"bytes", file.size()}};
    report_file->commit(report.dump(2) + "\n");
  }
  print_table(options.common, table_text(rows), true);
}

void run(Options& options) {
  require_distinct_files({{},
                          {{"-o", options.output},
                           {"the checkpoint of -o", options.output.string() + ".resume"},
                           {"--report", options.common.report}},
                          {}});
  options.training.seed = options.data.seed = options.common.seed;
  options.training = with_defaults(options.training);
  options.data.normals = options.training.form == NetworkForm::paper;
  tbb::task_arena arena(options.common.threads == 0 ? tbb::task_arena::automatic
                                                    : int(options.common.threads));
  try {
    arena.execute([&] { run_in_arena(options); });
  } catch (const Failure& failure) {
    if (failure.code() != NOOK_ERROR_CANCELLED) throw;
    throw ToolError(exit_other, !options.resume.empty() && std::filesystem::exists(options.resume)
                                    ? "stopped; run the same command again to continue from " + options.resume
                                    : std::string("stopped; nothing was written"));
  }
}

}  // namespace

void add_train_nnao(Command train) {
  const Command command =
      train.add_subcommand("nnao",
                           "train a network for the screen-space pass (NNAO) on procedural scenes.\nCtrl-C "
                           "stops the training. To continue it, run the same command again.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  command.add_option("-o,--output", o.output, "write the network to this .nook file").required();
  command
      .add_option_function(
          "--form",
          [&o](const std::string& name) {
            o.training.form = name == "paper" ? NetworkForm::paper : NetworkForm::horizon;
          },
          "form of the network: horizon (default, the form of the network that is built into Nook) or paper "
          "(Holden et al. 2016)")
      .check(one_of({"horizon", "paper"}))
      .type_name("NAME");
  command
      .add_option("--scenes", o.data.scenes,
                  "number of procedural scenes. A sixth of them is used only for validation. Default: 240")
      .check(in_range(48, 100000));
  command.add_option("--views", o.data.views, "number of camera views, of all scenes together. Default: 1440")
      .check(in_range(16, 1000000));
  command.add_option("--points", o.data.points_per_view, "number of points in each view. Default: 600")
      .check(in_range(1, 100000));
  command.add_option("--rays", o.data.rays, "number of rays per point. Default: 128")
      .check(in_range(1, 65536));
  command
      .add_option("--epochs", o.training.epochs,
                  "number of passes over the training points. Default: 40, or 12 with --form paper")
      .check(in_range(1, 100000));
  command
      .add_option("--time-limit", o.time_limit_s,
                  "stop after this many seconds of training; to continue, run the same command again. "
                  "Default: no limit")
      .check(positive_number());
  command
      .add_option("--dark-weight", o.training.dark_weight,
                  "for --form horizon: how much more dark points count in the loss. The weight of a point is "
                  "1 + w (1 - AO)^2, and this is w")
      .check(in_range(0.0, 100.0))
      .capture_default_str();
  command
      .add_option(
          "--batch", o.training.batch,
          "number of points per training step, a multiple of 16. Default: 256, or 64 with --form paper")
      .check(in_range(16, 65536));
  add_common_options(command, o.common);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
