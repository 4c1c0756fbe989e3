#include <optional>

#include "bakers/measure/nnao/sequence_comparison.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/evaluate.h"
#include "bakers/tool/nnao/traced_scenes.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"
#include "sdk/src/core/failure.h"

namespace nook::tool {

using namespace measure;
using Json = nlohmann::ordered_json;

Json evaluate_sequences(EvaluateNnaoOptions& options) {
  const Work work = read_work(options);
  options.truth.path.frames = sequence_frames;
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  const auto context = make_context();
  AoRequest request;
  request.max_radius_px = max_radius_px(options);
  std::vector<SequenceView> measured;
  // Scene by scene: the frames of all take a gigabyte.
  for (const SceneRequest& scene : work.scenes) {
    const std::vector<MeasuredView> views = traced_views(scene, options);
    platform::ProgressBar bar(options.common.quiet);
    for (std::size_t v = 0; v < views.size(); ++v) {
      bar.show(scene.name + ", measuring", "views", v, views.size());
      if (interrupted()) throw Failure(NOOK_ERROR_CANCELLED, "cancelled while measuring");
      measured.push_back(measure_sequence(*context, views[v], request));
    }
    bar.show(scene.name + ", measuring", "views", views.size(), views.size());
  }
  Json report = sequence_report(measured, options.common.seed);
  if (markdown) markdown->commit(sequence_markdown(report));
  report["step_px"] = options.truth.path.step_px;
  add_conditions(report, options, *context);
  return report;
}

}  // namespace nook::tool
