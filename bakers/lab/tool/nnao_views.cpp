// Measures single frames of scenes: the AO of every method (also as pictures), or bent normals.
#include <algorithm>
#include <optional>

#include "bakers/lab/nnao/bent_comparison.h"
#include "bakers/lab/nnao/screen_comparison.h"
#include "bakers/lab/nnao/view_pictures.h"
#include "bakers/lab/tool/nnao_scenes.h"
#include "bakers/tool/command_end.h"
#include "bakers/tool/evaluate_nnao.h"
#include "platform/output_file.h"
#include "platform/progress_bar.h"

namespace nook::lab {

using namespace measure;
using namespace tool;
using Json = nlohmann::ordered_json;

namespace {

// The panels of a picture, after the scene and the reference. blind_pairs.py reads the panels of `_pairs`.
struct Shown {
  const char* suffix;
  std::vector<std::pair<std::string, int>> methods;
};
const Shown sheets[] = {
    {"", {{"nnao", 9}, {"xegtao", 18}, {"gtao_bitmask", 16}, {"hbao", 64}}},
    {"_pairs", {{"nnao", 9}, {"xegtao", 18}, {"hbao", 16}, {"gtao", 16}}},
    {"_presets", {{half_name, 9}, {"nnao", 9}, {"nnao", 32}, {"gtao", 16}}},
    {"_shipped", {{"n8ao_shipped", 16}, {"s4ao_shipped", 12}, {"vtk_shipped", 32}, {"filament_shipped", 7}}}};

// Returns the picture names of the views: SCENE_CAMERA, or SCENE_NUMBER if the camera does not have a name.
std::vector<std::string> picture_names(std::span<const MeasuredView> views) {
  std::vector<std::string> names;
  std::size_t number = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    number = v > 0 && views[v].scene == views[v - 1].scene ? number + 1 : 0;
    std::string name = views[v].scene;
    name += '_';
    name += views[v].camera.empty() ? std::to_string(number) : views[v].camera;
    names.push_back(name);
  }
  return names;
}

void write_pictures_of(const std::filesystem::path& folder, const std::string& prefix,
                       const nook::nnao::Network& network, std::span<const MeasuredView> views,
                       std::span<const std::string> names) {
  platform::write_image(folder / (prefix + "_filters.png"), filter_picture(network));
  for (std::size_t v = 0; v < views.size(); ++v)
    platform::write_image(folder / (names[v] + "_" + prefix + "_units.png"), unit_picture(network, views[v]));
}

// Returns whether the sheet has a panel for the method.
bool is_shown(const std::string& method, int taps) {
  for (const Shown& sheet : sheets)
    for (const auto& [shown_method, shown_taps] : sheet.methods)
      if (method == shown_method && taps == shown_taps) return true;
  return false;
}

void write_sheets(const std::filesystem::path& folder, std::span<const MeasuredView> views,
                  std::span<const KeptImage> images) {
  const std::vector<std::string> names = picture_names(views);
  for (const Shown& sheet : sheets)
    for (std::size_t v = 0; v < views.size(); ++v) {
      std::vector<std::vector<float>> row;
      for (const auto& [method, taps] : sheet.methods)
        for (const KeptImage& image : images)
          if (image.view == v && image.method == method && image.taps == taps) row.push_back(image.ao);
      platform::write_image(folder / (names[v] + sheet.suffix + ".png"), make_sheet(views[v], row));
    }
}

void write_network_pictures(const std::filesystem::path& folder, const Networks& networks,
                            std::span<const MeasuredView> views) {
  const std::vector<std::string> names = picture_names(views);
  write_pictures_of(folder, "nnao", networks.embedded, views, names);
  if (!networks.file.empty()) write_pictures_of(folder, "other", networks.other, views, names);
}

// Returns the name of the other network in tables, or an empty string if none was given.
std::string other_name(const Networks& networks) {
  if (networks.file.empty()) return "";
  return networks.other.form == nook::nnao::NetworkForm::paper ? "nnao_paper" : "nnao_file";
}

constexpr const char* thin_scene = "thin";  // the built-in scene's name

void check_methods(const std::vector<std::string>& methods, const std::string& other) {
  for (const std::string& method : methods)
    for (const std::string of_file : {"nnao_paper", "nnao_file"})
      if (method.substr(0, method.find(':')) == of_file && of_file != other)
        throw ToolError(exit_bad_arguments,
                        "evaluate nnao: --methods: the file of --network does not provide " + method);
  for (const std::string& method : methods)
    for (const std::string& of_frames : frame_method_names())
      if (method.substr(0, method.find(':')) == of_frames)
        throw ToolError(exit_bad_arguments, "evaluate nnao: --methods: " + method + " is only for --frame");
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
    throw ToolError(exit_bad_arguments,
                    "evaluate nnao: --methods: none of these methods is measured with these taps");
  if (!options.images.empty()) {
    write_sheets(options.images, views, comparison.images);
    // No network pictures are written for a list of views, because it has too many views.
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

}  // namespace nook::lab
