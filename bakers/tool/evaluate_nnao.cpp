// nook evaluate nnao: the screen-space pass and its baselines against ray tracing, on OpenGL without a
// display.
#include <memory>
#include <nlohmann/json.hpp>

#include "bakers/tool/command_line.h"
#include "bakers/tool/commands.h"
#include "bakers/tool/evaluation.h"
#include "bakers/tool/nnao/evaluate.h"
#include "bakers/tool/nnao/evaluate_frames.h"
#include "bakers/tool/nnao/networks.h"
#include "bakers/tool/nnao/options.h"
#include "bakers/tool/nnao/traced_scenes.h"

namespace nook::tool {
namespace {

nlohmann::ordered_json replay(const EvaluateNnaoOptions& options) {
  const Networks networks = read_networks(options.network);
  const auto context = make_context();
  return evaluate_frames(
      *context, {options.frames, options.methods, networks.file, options.images, options.common.quiet});
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
  const Command command =
      evaluate_command.add_subcommand("nnao",
                                      "the screen-space pass, and SSAO, SSAO+, HBAO, GTAO, "
                                      "GTAO with a visibility bitmask, XeGTAO, and forms of "
                                      "what N8AO, Godot, VTK, QGIS and Filament ship, "
                                      "against ray tracing");
  const auto options = std::make_shared<EvaluateNnaoOptions>();
  add_options(command, *options);
  command.callback([options] { run(*options); });
}

}  // namespace nook::tool
