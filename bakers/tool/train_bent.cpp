// `nook train bent` fits the specular occlusion of characters and writes its weights as a header.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bakers/measure/character/bent_study.h"
#include "bakers/measure/character/evaluated_character.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  CommonOptions common;
  EvaluatedFiles files;
  std::filesystem::path output;
  std::size_t poses = 20;  // picked at even intervals from the clips
  measure::BentStudy study{.points = 1500};
  bake::nnao::SpecularFitSettings fit;
};

Json train(const Options& options) {
  platform::OutputFile output(options.output, file_events(options.common.quiet));
  const measure::BakedCharacter baked = read_evaluated_files(options.files, options.common);
  measure::PoseChoice choice;
  choice.most = options.poses;
  const measure::EvaluatedPoses measured = measure::choose_poses(baked.character, nullptr, choice);
  platform::ProgressBar bar(options.common.quiet);
  const auto samples = measure::bent_samples(baked.character.mesh, baked.model, measured.poses, options.study,
                                             [&](std::size_t done, std::size_t total) {
                                               bar.show("ray tracing", "poses", done, total);
                                               return !interrupted();
                                             });
  const nook::nnao::SpecularNumbers numbers = bake::nnao::fit_specular(samples, options.fit);
  const bake::nnao::SpecularError error = bake::nnao::specular_error(samples, numbers);
  output.commit(measure::character_specular_header(numbers));
  Json row{{"poses", measured.poses.size()},
           {"points", samples.size()},
           {"rays", options.study.rays},
           {"mse", error.fitted},
           {"mse_lagarde", error.lagarde}};
  return {{"rows", Json::array({std::move(row)})}, {"seed", options.common.seed}};
}

}  // namespace

void add_train_bent(Command train_command) {
  const Command command = train_command.add_subcommand(
      "bent",
      "fit the formula for the specular occlusion of characters to ray tracing.\nThe formula computes "
      "specular occlusion from AO and bent normals. Its numbers are fitted on one character that was baked "
      "with bent normals.");
  const auto options = std::make_shared<Options>();
  Options& o = *options;
  add_evaluated_files(command, o.files);
  command
      .add_option("-o,--output", o.output,
                  "write the numbers to this C++ header, such as shaders/character/specular_numbers.h")
      .required();
  command
      .add_option("--max-poses", o.poses, "number of poses to fit, picked at even intervals from all clips")
      .check(in_range(1, 100000))
      .capture_default_str();
  command.add_option("--points", o.study.points, "number of vertices to fit in each pose")
      .check(in_range(1, 10000000))
      .capture_default_str();
  command.add_option("--steps", o.fit.steps, "number of optimisation steps of the fit")
      .check(in_range(1, 1000000))
      .capture_default_str();
  add_common_options(command, o.common);
  command.callback([options] {
    options->study.seed = options->fit.seed = options->common.seed;
    run_evaluation(options->common, {named_files(options->files), {{"-o", options->output.string()}}, {}},
                   [&] { return train(*options); });
  });
}

}  // namespace nook::tool
