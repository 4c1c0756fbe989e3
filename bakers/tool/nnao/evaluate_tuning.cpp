#include <cstdio>

#include "bakers/measure/nnao/tuning.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/evaluate.h"
#include "bakers/tool/nnao/traced_scenes.h"
#include "platform/progress_bar.h"

namespace nook::tool {

using namespace measure;
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
      std::fprintf(stderr, "%s %d: the best %s is the last of its grid\n", baseline_name(t.method.baseline),
                   t.method.taps, axis.c_str());
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

}  // namespace nook::tool
