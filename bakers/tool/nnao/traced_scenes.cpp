#include "bakers/tool/nnao/traced_scenes.h"

#include <algorithm>

#include "bakers/tool/input_file.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/views_file.h"
#include "bakers/tool/tool_error.h"
#include "platform/progress_bar.h"

namespace nook::tool {

using namespace measure;

namespace {

void keep_sources(std::vector<SceneRequest>& scenes, const std::vector<std::string>& sources) {
  for (const std::string& source : sources)
    if (std::ranges::find(scenes, source, &SceneRequest::source) == scenes.end())
      throw ToolError(exit_bad_arguments, "evaluate nnao: --sources: the list has no " + source);
  if (!sources.empty())
    std::erase_if(scenes, [&](const SceneRequest& scene) {
      return std::ranges::find(sources, scene.source) == sources.end();
    });
}

}  // namespace

Work read_work(EvaluateNnaoOptions& options) {
  Work work;
  work.scenes = parse_scenes(options.scenes);
  if (!options.views.empty()) {
    ViewsFile file = read_views_file(options.views, options.folder);
    if (!file.size.empty() && !options.sized) parse_size(file.size, options.truth);
    if (file.rays > 0 && !options.rays_given) options.truth.rays = file.rays;
    keep_sources(file.scenes, options.sources);
    work.scenes.insert(work.scenes.begin(), file.scenes.begin(), file.scenes.end());
    work.ratios = std::move(file.ratios);
  }
  for (const std::string& text : options.ratios) work.ratios.push_back(parse_ratio(text));
  return work;
}

std::vector<MeasuredView> traced_views(const SceneRequest& scene, const EvaluateNnaoOptions& options) {
  platform::ProgressBar bar(options.common.quiet);
  const std::string label = scene.name + ", ray tracing";
  return naming_file(scene.file, [&] {
    return trace_views(scene, options.truth, options.placed_cameras, options.references,
                       [&](std::size_t done, std::size_t total) {
                         bar.show(label, "views", done, total);
                         return !interrupted();
                       });
  });
}

std::vector<MeasuredView> traced_views(const Work& work, const EvaluateNnaoOptions& options) {
  if (!options.references.empty()) std::filesystem::create_directories(options.references);
  std::vector<MeasuredView> views;
  for (const SceneRequest& scene : work.scenes)
    for (MeasuredView& view : traced_views(scene, options)) views.push_back(std::move(view));
  return views;
}

std::unique_ptr<platform::Context> make_context() {
  platform::ContextRequest request;
  request.major = request.minor = 3;
  return platform::create_context(request);
}

void add_conditions(nlohmann::ordered_json& report, const EvaluateNnaoOptions& options,
                    platform::Context& context) {
  report["rays"] = options.truth.rays;
  report["opengl"] = context.version();
  report["seed"] = options.common.seed;
}

float max_radius_px(const EvaluateNnaoOptions& options) {
  return options.max_radius_px > 0 ? options.max_radius_px : 0.5f * float(options.truth.height);
}

}  // namespace nook::tool
