// Makes the rows of `nook-lab evaluate nnao`, their means over scenes, and the tables of docs/lab/nnao.md.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/lab/nnao/row_statistics.h"
#include "bakers/lab/nnao/screen_comparison.h"

namespace nook::lab {

// A named group of views of a comparison: all views of a scene, or all views of a source.
struct ViewGroup {
  std::string name;
  std::vector<std::size_t> views;  // indices
  bool is_built_in = false;        // true for built-in scenes, which are left out of means
};

// Returns one object per row. image_bias.h explains dark_bias and calibration. `border_bias` is the mean of
// AO - truth within 20 px of any border, minus the mean inside. `flicker` is null for the oracles.
// `ratio_to_nnao` is the time divided by the time of nnao with 64 taps.
nlohmann::ordered_json nnao_rows(const Comparison& comparison, const ViewGroup& group,
                                 const std::string& resolution, const std::string& gpu);

// Returns one object for each method with a blur. It has the mean of AO - truth in each band of each border,
// with the outermost band first, and the mean inside all bands.
nlohmann::ordered_json nnao_border_rows(const Comparison& comparison, const ViewGroup& group);

// Returns one object for each view and row of the comparison.
nlohmann::ordered_json nnao_view_rows(const Comparison& comparison, std::span<const MeasuredView> views);

// Returns the mean of every numeric field over the groups that are not built in, as a row of the scene
// "mean". There is one such row for each combination of method, number of taps and blur. `dark_bias` and
// `calibration` are computed over all pixels of these groups. Returns nothing if there are fewer than two
// such groups. `rows` are the rows of all groups, made by nnao_rows.
nlohmann::ordered_json nnao_mean_rows(const nlohmann::ordered_json& rows, const Comparison& comparison,
                                      std::span<const ViewGroup> groups);

// Two methods whose errors are compared.
struct MethodRatio {
  std::string method, over;  // names in tables
  int taps = 0, over_taps = 0;
};

// Returns one object for each ratio whose two methods were measured. A ratio compares the blurred `mse` of
// both methods. If a method has no blur, its raw `mse` is used. The ratio is computed over all views of the
// groups that are not built in.
nlohmann::ordered_json nnao_ratio_rows(const Comparison& comparison, std::span<const MeasuredView> views,
                                       std::span<const ViewGroup> groups, std::span<const MethodRatio> ratios,
                                       std::uint64_t seed);

// Returns Markdown tables: the blurred `mse` of each scene and its mean, the means of every column, and the
// ratios if there are any.
std::string nnao_markdown(const nlohmann::ordered_json& rows, const nlohmann::ordered_json& ratios);

}  // namespace nook::lab
