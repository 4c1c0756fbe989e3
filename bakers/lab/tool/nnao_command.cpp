// nook-lab evaluate nnao: compares the screen-space pass and its baselines with ray tracing, on OpenGL
// without a display. The command also runs the search that tunes the baselines.
#include <cstdio>
#include <memory>

#include "bakers/lab/nnao/baseline_pass.h"
#include "bakers/lab/nnao/tuning.h"
#include "bakers/lab/tool/lab_commands.h"
#include "bakers/lab/tool/nnao_options.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/command_line.h"
#include "bakers/tool/evaluate_nnao.h"
#include "bakers/tool/evaluation.h"
#include "platform/progress_bar.h"

namespace nook::lab {

using namespace measure;
using namespace tool;
using Json = nlohmann::ordered_json;

Json evaluate_tuning(const EvaluateNnaoOptions& options) {
  platform::ProgressBar bar(options.common.quiet);
  const std::vector<MeasuredView> views =
      tuning_views(options.common.seed, [&](std::size_t done, std::size_t total) {
        bar.show("ray tracing", "views", done, total);
        return !interrupted();
      });
  const auto context = make_context();
  std::vector<BaselineMethod> methods;
  for (const BaselineMethod& method : baseline_methods())
    if (!method.shipped && (options.tune == "all" || options.tune == baseline_name(method.baseline)))
      methods.push_back(method);
  const std::vector<TunedBaseline> tuned =
      tune_baselines(*context, views, methods, [&](std::size_t done, std::size_t total) {
        bar.show("tuning", "methods", done, total);
        return !interrupted();
      });
  Json report;
  report["rows"] = Json::array();
  for (const TunedBaseline& t : tuned) {
    std::fputs(tuning_line(t.method).c_str(), stdout);
    for (const std::string& axis : t.at_edge)
      std::fprintf(stderr,
                   "%s with %d taps: the best value of %s is at the end of its range, so a better one may "
                   "lie beyond\n",
                   baseline_name(t.method.baseline), t.method.taps, axis.c_str());
    report["rows"].push_back({{"method", baseline_name(t.method.baseline)},
                              {"taps", t.method.taps},
                              {"radius_scale", t.method.tuning.radius_scale},
                              {"power", t.method.tuning.power},
                              {"shape", t.method.tuning.shape},
                              {"thin", t.method.tuning.thin},
                              {"equal_weights", t.method.tuning.equal_weights},
                              {"border", border_name(t.method.tuning.border)},
                              {"denoiser", denoiser_name(t.method.tuning.denoiser)},
                              {"at_edge", t.at_edge},
                              {"mse", t.mse}});
  }
  return report;
}

namespace {

Json replay(const EvaluateNnaoOptions& options) {
  const Networks networks = read_networks(options.network);
  const auto context = make_context();
  return evaluate_frames(
      *context, {options.frames, options.methods, networks.file, options.images, options.common.quiet},
      frame_baselines);
}

void run(EvaluateNnaoOptions& options) {
  check_options(options);
  options.truth.seed = options.common.seed;
  CommandFiles files{{{"--network", options.network}}, {{"--markdown", options.markdown}}, options.images};
  if (!options.views.empty()) files.inputs.push_back({"--views", options.views});
  for (const std::filesystem::path& scene : options.scenes.files) files.inputs.push_back({"a scene", scene});
  for (const std::filesystem::path& frame : options.frames) files.inputs.push_back({"--frame", frame});
  for (const std::filesystem::path& mover : options.movers) files.inputs.push_back({"--mover", mover});
  run_evaluation(options.common, files, [&] {
    if (!options.frames.empty()) return replay(options);
    if (!options.tune.empty()) return evaluate_tuning(options);
    if (!options.movers.empty()) return evaluate_movers(options);
    if (options.temporal) return evaluate_sequences(options);
    return options.bent ? evaluate_bent_normals(options) : evaluate_views(options);
  });
}

}  // namespace

void add_evaluate_nnao(Command evaluate_command) {
  const Command command = evaluate_command.add_subcommand(
      "nnao",
      "compare Nook's screen-space pass (NNAO) and other methods with ray tracing.\nThe other methods are "
      "SSAO, SSAO+, HBAO, GTAO, GTAO with a visibility bitmask, XeGTAO, and the methods of N8AO, Godot, VTK, "
      "QGIS and Filament.");
  const auto options = std::make_shared<EvaluateNnaoOptions>();
  add_options(command, *options);
  command.callback([options] { run(*options); });
}

}  // namespace nook::lab
