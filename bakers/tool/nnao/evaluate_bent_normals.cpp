#include <optional>

#include "bakers/measure/nnao/bent_comparison.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/evaluate.h"
#include "bakers/tool/nnao/traced_scenes.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {

using namespace measure;
using Json = nlohmann::ordered_json;

Json evaluate_bent_normals(EvaluateNnaoOptions& options) {
  const Work work = read_work(options);
  options.truth.bent_stride = 4;
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  const auto context = make_context();
  const std::vector<MeasuredView> views = traced_views(work, options);
  AoRequest request;
  request.max_radius_px = max_radius_px(options);
  platform::ProgressBar bar(options.common.quiet);
  Json report;
  report["rows"] = bent_rows(*context, views, request, [&](std::size_t done, std::size_t total) {
    bar.show("measuring", "methods", done, total);
    return !interrupted();
  });
  if (markdown) markdown->commit(bent_markdown(report["rows"]));
  report["roughness"] = measured_roughness;
  add_conditions(report, options, *context);
  return report;
}

}  // namespace nook::tool
