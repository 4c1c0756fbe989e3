#include "bakers/measure/nnao/frame_report.h"

#include <algorithm>
#include <set>

namespace nook::measure {
namespace {

using Json = nlohmann::ordered_json;

template <class Number>
Json or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

double mean_of(std::span<const float> values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return values.empty() ? 0 : sum / double(values.size());
}

bool same_method(const Json& a, const Json& b) {
  return a["method"] == b["method"] && a["taps"] == b["taps"] && a["half"] == b["half"] &&
         a["blur"] == b["blur"] && a["network"] == b["network"];
}

}  // namespace

Json frame_rows(const std::string& frame, const nook::nnao::Recording& recording,
                std::span<const FrameRow> rows) {
  Json out = Json::array();
  for (const FrameRow& row : rows) {
    const bool has_difference = row.from_recorded.has_value();
    const AoDifference difference = row.from_recorded.value_or(AoDifference{});
    const auto of_difference = [&](double value) { return has_difference ? Json(value) : Json(); };
    out.push_back({{"frame", frame},
                   {"method", row.method},
                   {"taps", row.pass.taps},
                   {"half", row.is_library ? Json(row.pass.half_resolution != 0) : Json()},
                   {"blur", row.is_library ? Json(row.pass.blur) : Json()},
                   {"network", row.is_library ? Json(row.network) : Json()},
                   {"resolution", std::to_string(recording.width) + "x" + std::to_string(recording.height)},
                   {"mean_ao", mean_of(row.ao)},
                   {"mean_difference", of_difference(difference.mean)},
                   {"largest_difference", of_difference(difference.largest)},
                   {"share_beyond_step", of_difference(difference.share_beyond)},
                   {"oracle_mse", or_null(row.oracle_mse)},
                   {"oracle_bias", or_null(row.oracle_bias)}});
  }
  return out;
}

Json frame_mean_rows(const Json& rows) {
  Json means = Json::array();
  std::set<std::string> frames;
  for (const Json& row : rows) frames.insert(row["frame"].get<std::string>());
  if (frames.size() < 2) return means;
  for (const Json& row : rows) {
    if (std::ranges::any_of(means, [&](const Json& mean) { return same_method(mean, row); })) continue;
    Json mean = row;
    mean["frame"] = "mean";
    mean["resolution"] = nullptr;
    for (const char* key : {"mean_ao", "mean_difference", "largest_difference", "share_beyond_step",
                            "oracle_mse", "oracle_bias"}) {
      double sum = 0, largest = 0, count = 0;
      for (const Json& other : rows) {
        if (!same_method(other, row) || other[key].is_null()) continue;
        sum += other[key].get<double>();
        largest = std::max(largest, other[key].get<double>());
        count += 1;
      }
      if (count > 0) mean[key] = std::string(key) == "largest_difference" ? largest : sum / count;
    }
    means.push_back(mean);
  }
  return means;
}

}  // namespace nook::measure
