#include "bakers/measure/nnao/report.h"

#include <cmath>
#include <cstdio>
#include <vector>

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;

const std::string mean_scene = "mean";

bool same_method(const Json& a, const Json& b) {
  return a["method"] == b["method"] && a["taps"] == b["taps"] && a["blurred"] == b["blurred"];
}

// Scientific with two decimals, its exponent without zeros: 7.97e-3.
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
  std::string text = head({"method", "taps", "blurred", "mse", "rmse", "ssim", "r", "border_bias", "flicker",
                           "fetches", "ms", "ratio_to_nnao"});
  const std::string shown = scenes_of(rows).back();
  for (const Json& row : rows)
    if (row["scene"] == shown)
      text += line({row["method"], row["taps"].dump(), row["blurred"] ? "yes" : "no", short_power(row["mse"]),
                    decimals(row["rmse"], 3), decimals(row["ssim"], 3), decimals(row["r"], 3),
                    decimals(row["border_bias"], 3), decimals(row["flicker"], 4), row["fetches"].dump(),
                    decimals(row["ms"], 0), decimals(row["ratio_to_nnao"], 2)});
  return text;
}

}  // namespace

Json nnao_rows(const Comparison& comparison, const std::string& scene, const std::string& resolution,
               const std::string& gpu) {
  Json rows = Json::array();
  for (const ComparisonRow& r : comparison.rows) {
    double reference = r.ms;
    for (const ComparisonRow& other : comparison.rows)
      if (other.method == "nnao" && other.taps == 64 && other.blurred == r.blurred) reference = other.ms;
    rows.push_back({{"method", r.method},
                    {"taps", r.taps},
                    {"blurred", r.blurred},
                    {"scene", scene},
                    {"resolution", resolution},
                    {"gpu", gpu},
                    {"mse", r.mse},
                    {"rmse", std::sqrt(r.mse)},
                    {"ssim", r.ssim},
                    {"r", r.correlation},
                    {"border_bias", r.border.rim()},
                    {"flicker", r.flicker},
                    {"fetches", r.fetches},
                    {"ms", r.ms},
                    {"ratio_to_nnao", r.ms / reference}});
  }
  return rows;
}

Json nnao_border_rows(const Comparison& comparison, const std::string& scene) {
  using namespace bake::nnao;
  Json rows = Json::array();
  for (const ComparisonRow& r : comparison.rows) {
    if (!r.blurred) continue;
    Json row{{"method", r.method}, {"taps", r.taps}, {"scene", scene}};
    for (std::size_t border = 0; border < border_names.size(); ++border) {
      Json& bands = row[border_names[border]] = Json::array();
      for (std::size_t band = 0; band < border_bands_px.size(); ++band)
        bands.push_back(r.border.at(border, band));
    }
    row["inside"] = r.border.inside();
    rows.push_back(row);
  }
  return rows;
}

Json nnao_mean_rows(const Json& rows) {
  Json means = Json::array();
  for (const Json& method : rows) {
    if (method["scene"] != rows.front()["scene"]) continue;
    Json mean = method;
    mean["scene"] = mean_scene;
    for (const char* key : {"mse", "rmse", "ssim", "r", "border_bias", "flicker", "ms", "ratio_to_nnao"}) {
      double sum = 0, count = 0;
      for (const Json& row : rows)
        if (same_method(row, method)) {
          sum += row[key].get<double>();
          count += 1;
        }
      mean[key] = sum / count;
    }
    means.push_back(mean);
  }
  return means;
}

std::string nnao_markdown(const Json& rows) {
  return scene_table(rows) + "\n" + mean_table(rows);
}

}  // namespace nook::measure
