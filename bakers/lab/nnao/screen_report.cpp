#include "bakers/lab/nnao/screen_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace nook::lab {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

const std::string mean_scene = "mean";

bool same_method(const Json& a, const Json& b) {
  return a["method"] == b["method"] && a["taps"] == b["taps"] && a["blurred"] == b["blurred"];
}

// Returns a value with two decimals and a short exponent, such as 7.97e-3.
std::string short_power(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2e", value);
  const std::string digits = text;
  const std::size_t e = digits.find('e');
  return digits.substr(0, e + 1) + std::to_string(std::stoi(digits.substr(e + 1)));
}

std::string decimals(double value, int count) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", count, value);
  return text;
}

std::string line(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string head(const std::vector<std::string>& names) {
  std::string rule = "|";
  for (std::size_t i = 0; i < names.size(); ++i) rule += "---|";
  return line(names) + rule + "\n";
}

std::vector<std::string> scenes_of(const Json& rows) {
  std::vector<std::string> scenes;
  for (const Json& row : rows) {
    const auto scene = row["scene"].get<std::string>();
    if (scenes.empty() || scenes.back() != scene) scenes.push_back(scene);
  }
  return scenes;
}

std::string scene_table(const Json& rows) {
  const std::vector<std::string> scenes = scenes_of(rows);
  std::vector<std::string> names{"method", "taps"};
  names.insert(names.end(), scenes.begin(), scenes.end());
  std::string text = head(names);
  for (const Json& method : rows) {
    if (method["scene"] != scenes.front() || !method["blurred"]) continue;
    std::vector<std::string> cells{method["method"], method["taps"].dump()};
    for (const Json& row : rows)
      if (same_method(row, method)) cells.push_back(short_power(row["mse"]));
    text += line(cells);
  }
  return text;
}

std::string mean_table(const Json& rows) {
  std::string text = head({"method", "taps", "blurred", "denoiser", "mse", "rmse", "ssim", "r", "dark_bias",
                           "calibration", "border_bias", "flicker", "fetches", "ms", "ratio_to_nnao"});
  const std::string shown = scenes_of(rows).back();
  for (const Json& row : rows)
    if (row["scene"] == shown)
      text +=
          line({row["method"], row["taps"].dump(), row["blurred"] ? "yes" : "no", row["denoiser"],
                short_power(row["mse"]), decimals(row["rmse"], 3), decimals(row["ssim"], 3),
                decimals(row["r"], 3), decimals(row["dark_bias"], 3), decimals(row["calibration"], 3),
                decimals(row["border_bias"], 3), row["flicker"].is_null() ? "-" : decimals(row["flicker"], 4),
                row["fetches"].dump(), decimals(row["ms"], 0), decimals(row["ratio_to_nnao"], 2)});
  return text;
}

std::string method_name(const Json& name, const Json& taps) {
  return name.get<std::string>() + " " + taps.dump();
}

std::string ratio_table(const Json& ratios) {
  std::vector<std::string> names{"mse of", "over", "ratio", "5 %", "95 %", "95 %, sources drawn"};
  for (const auto& source : ratios.front()["sources"].items()) names.push_back(source.key());
  std::string text = head(names);
  for (const Json& row : ratios) {
    std::vector<std::string> cells{method_name(row["method"], row["taps"]),
                                   method_name(row["over"], row["over_taps"])};
    for (const char* key : {"ratio", "lower_95", "upper_95", "upper_95_sources"})
      cells.push_back(decimals(row[key], 3));
    for (const auto& source : row["sources"].items()) cells.push_back(decimals(source.value(), 2));
    text += line(cells);
  }
  return text;
}

// Returns the time of nnao with 64 taps. If nnao was not measured with 64 taps, returns `own`.
double reference_ms(const Comparison& comparison, const ViewGroup& group, bool blurred, double own) {
  for (const ComparisonRow& row : comparison.rows)
    if (row.method == "nnao" && row.taps == 64 && row.blurred == blurred)
      return pooled(row, group.views).median_ms();
  return own;
}

// Returns the indices of the views of all groups, except groups that are left out of means.
std::vector<std::size_t> counted_views(std::span<const ViewGroup> groups) {
  std::vector<std::size_t> views;
  for (const ViewGroup& group : groups)
    if (!group.is_built_in) views.insert(views.end(), group.views.begin(), group.views.end());
  return views;
}

// Returns the row that represents a method in ratios, or null if there is none.
const ComparisonRow* find_row(const Comparison& comparison, const std::string& method, int taps) {
  const ComparisonRow* found = nullptr;
  for (const ComparisonRow& row : comparison.rows)
    if (row.method == method && row.taps == taps && (row.blurred || !found)) found = &row;
  return found;
}

}  // namespace

Json nnao_rows(const Comparison& comparison, const ViewGroup& group, const std::string& resolution,
               const std::string& gpu) {
  Json rows = Json::array();
  for (const ComparisonRow& r : comparison.rows) {
    const Measurement all = pooled(r, group.views);
    const double ms = all.median_ms();
    rows.push_back({{"method", r.method},
                    {"taps", r.taps},
                    {"blurred", r.blurred},
                    {"denoiser", r.denoiser},
                    {"scene", group.name},
                    {"resolution", resolution},
                    {"gpu", gpu},
                    {"mse", all.error.mse()},
                    {"rmse", std::sqrt(all.error.mse())},
                    {"ssim", all.error.ssim()},
                    {"r", all.error.correlation()},
                    {"dark_bias", all.calibration.dark_bias()},
                    {"calibration", all.calibration.largest_bias()},
                    {"border_bias", all.border.rim()},
                    {"flicker", all.flicker.empty() ? Json() : Json(all.mean_flicker())},
                    {"fetches", r.fetches},
                    {"ms", ms},
                    {"ratio_to_nnao", ms / reference_ms(comparison, group, r.blurred, ms)}});
  }
  return rows;
}

Json nnao_border_rows(const Comparison& comparison, const ViewGroup& group) {
  using namespace bake::nnao;
  Json rows = Json::array();
  for (const ComparisonRow& r : comparison.rows) {
    if (!r.blurred) continue;
    const BorderBias bias = pooled(r, group.views).border;
    Json row{{"method", r.method}, {"taps", r.taps}, {"scene", group.name}};
    for (std::size_t border = 0; border < border_names.size(); ++border) {
      Json& bands = row[border_names[border]] = Json::array();
      for (std::size_t band = 0; band < border_bands_px.size(); ++band)
        bands.push_back(bias.at(border, band));
    }
    row["inside"] = bias.inside();
    rows.push_back(row);
  }
  return rows;
}

Json nnao_view_rows(const Comparison& comparison, std::span<const MeasuredView> views) {
  Json rows = Json::array();
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const ComparisonRow& r : comparison.rows) {
      const Measurement& one = r.views[v];
      rows.push_back({{"view", v},
                      {"source", views[v].source},
                      {"scene", views[v].scene},
                      {"camera", views[v].camera},
                      {"radius", views[v].radius},
                      {"noise_floor_mse", views[v].noise},
                      {"method", r.method},
                      {"taps", r.taps},
                      {"blurred", r.blurred},
                      {"mse", one.error.mse()},
                      {"ssim", one.error.ssim()},
                      {"dark_bias", one.calibration.dark_bias()},
                      {"calibration", one.calibration.largest_bias()},
                      {"flicker", one.flicker.empty() ? Json() : Json(one.mean_flicker())}});
    }
  return rows;
}

Json nnao_mean_rows(const Json& rows, const Comparison& comparison, std::span<const ViewGroup> groups) {
  Json means = Json::array();
  if (std::ranges::count(groups, false, &ViewGroup::is_built_in) < 2) return means;
  const std::vector<std::size_t> views = counted_views(groups);
  const std::size_t methods = comparison.rows.size();
  for (std::size_t m = 0; m < methods; ++m) {
    Json mean = rows[m];
    mean["scene"] = mean_scene;
    for (const char* key : {"mse", "rmse", "ssim", "r", "border_bias", "flicker", "ms", "ratio_to_nnao"}) {
      if (mean[key].is_null()) continue;
      double sum = 0, count = 0;
      for (std::size_t g = 0; g < groups.size(); ++g)
        if (!groups[g].is_built_in) {
          sum += rows[g * methods + m][key].get<double>();
          count += 1;
        }
      mean[key] = sum / count;
    }
    const Measurement all = pooled(comparison.rows[m], views);
    mean["dark_bias"] = all.calibration.dark_bias();
    mean["calibration"] = all.calibration.largest_bias();
    means.push_back(mean);
  }
  return means;
}

Json nnao_ratio_rows(const Comparison& comparison, std::span<const MeasuredView> views,
                     std::span<const ViewGroup> groups, std::span<const MethodRatio> ratios,
                     std::uint64_t seed) {
  Json rows = Json::array();
  const std::vector<std::size_t> counted = counted_views(groups);
  if (counted.empty()) return rows;
  for (const MethodRatio& ratio : ratios) {
    const ComparisonRow* const method = find_row(comparison, ratio.method, ratio.taps);
    const ComparisonRow* const over = find_row(comparison, ratio.over, ratio.over_taps);
    if (!method || !over) continue;
    std::vector<ErrorPair> pairs;
    for (const std::size_t v : counted)
      pairs.push_back({views[v].source, method->views[v].error.mse(), over->views[v].error.mse()});
    const RatioStatistics statistics = compare_errors(pairs, seed);
    Json sources = Json::object();
    for (const SourceRatio& source : statistics.sources) sources[source.source] = source.ratio;
    rows.push_back({{"method", ratio.method},
                    {"taps", ratio.taps},
                    {"over", ratio.over},
                    {"over_taps", ratio.over_taps},
                    {"views", statistics.views},
                    {"ratio", statistics.ratio},
                    {"lower_95", statistics.lower_95},
                    {"upper_95", statistics.upper_95},
                    {"upper_95_sources", statistics.upper_95_sources},
                    {"sources", sources}});
  }
  return rows;
}

std::string nnao_markdown(const Json& rows, const Json& ratios) {
  std::string text = scene_table(rows) + "\n" + mean_table(rows);
  if (!ratios.empty()) text.append(1, '\n').append(ratio_table(ratios));
  return text;
}

}  // namespace nook::lab
