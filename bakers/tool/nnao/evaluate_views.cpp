#include <algorithm>
#include <optional>

#include "bakers/measure/nnao/comparison.h"
#include "bakers/measure/nnao/frame_comparison.h"
#include "bakers/tool/interrupt.h"
#include "bakers/tool/nnao/evaluate.h"
#include "bakers/tool/nnao/networks.h"
#include "bakers/tool/nnao/traced_scenes.h"
#include "bakers/tool/nnao/view_pictures.h"
#include "bakers/tool/tool_error.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::tool {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* thin_scene = "thin";  // the built-in scene's name

void check_methods(const std::vector<std::string>& methods, const std::string& other) {
  for (const std::string& method : methods)
    for (const std::string of_file : {"nnao_paper", "nnao_file"})
      if (method.substr(0, method.find(':')) == of_file && of_file != other)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: --network gives no " + method);
  for (const std::string& method : methods)
    for (const std::string& of_frames : frame_method_names())
      if (method.substr(0, method.find(':')) == of_frames)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: " + method + " is of --frame alone");
}

Comparison compare_views(const EvaluateNnaoOptions& options, platform::Context& context,
                         const Networks& networks, std::span<const MeasuredView> views) {
  ComparisonSettings settings;
  settings.other_network = networks.file;
  settings.other_name = other_name(networks);
  settings.methods = options.methods;
  settings.raw = options.raw;
  settings.request.max_radius_px = max_radius_px(options);
  settings.request.intensity = options.intensity;
  platform::ProgressBar bar(options.common.quiet);
  return compare(
      context, views, settings,
      [&](const std::string& method, int taps) { return !options.images.empty() && is_shown(method, taps); },
      [&](std::size_t done, std::size_t total) {
        bar.show("measuring", "methods", done, total);
        return !interrupted();
      });
}

// The views of each source in their order.
std::vector<ViewGroup> group_views(std::span<const MeasuredView> views, bool has_thin) {
  std::vector<ViewGroup> groups;
  for (std::size_t v = 0; v < views.size(); ++v) {
    auto group = std::ranges::find(groups, views[v].source, &ViewGroup::name);
    if (group == groups.end())
      group = groups.insert(group, {views[v].source, {}, has_thin && views[v].source == thin_scene});
    group->views.push_back(v);
  }
  return groups;
}

Json scene_summary(const ViewGroup& group, std::span<const MeasuredView> views) {
  double noise = 0;
  for (const std::size_t v : group.views) noise += views[v].noise / double(group.views.size());
  return {{"scene", group.name},
          {"views", group.views.size()},
          {"radius", views[group.views.front()].radius},
          {"noise_floor_mse", noise}};
}

}  // namespace

Json evaluate_views(EvaluateNnaoOptions& options) {
  const Work work = read_work(options);
  const Networks networks = read_networks(options.network);
  std::optional<platform::OutputFile> markdown;
  if (!options.markdown.empty()) markdown.emplace(options.markdown);
  check_methods(options.methods, other_name(networks));
  const auto context = make_context();
  const std::vector<MeasuredView> views = traced_views(work, options);
  const Comparison comparison = compare_views(options, *context, networks, views);
  if (comparison.rows.empty())
    throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: none is measured with these taps");
  if (!options.images.empty()) {
    write_sheets(options.images, views, comparison.images);
    // A list has too many views for pictures of the networks.
    if (options.views.empty()) write_network_pictures(options.images, networks, views);
  }

  const std::string resolution =
      std::to_string(options.truth.width) + "x" + std::to_string(options.truth.height);
  const std::vector<ViewGroup> groups = group_views(views, options.scenes.thin);
  Json report, rows = Json::array(), borders = Json::array(), scenes = Json::array();
  for (const ViewGroup& group : groups) {
    for (const Json& row : nnao_rows(comparison, group, resolution, context->renderer())) rows.push_back(row);
    for (const Json& row : nnao_border_rows(comparison, group)) borders.push_back(row);
    scenes.push_back(scene_summary(group, views));
  }
  for (const Json& row : nnao_mean_rows(rows, comparison, groups)) rows.push_back(row);
  const Json ratios = nnao_ratio_rows(comparison, views, groups, work.ratios, options.common.seed);
  if (markdown) markdown->commit(nnao_markdown(rows, ratios));
  report["rows"] = std::move(rows);
  report["scenes"] = std::move(scenes);
  report["borders"] = std::move(borders);
  report["ratios"] = ratios;
  report["views"] = nnao_view_rows(comparison, views);
  report["intensity"] = options.intensity;
  add_conditions(report, options, *context);
  return report;
}

}  // namespace nook::tool
