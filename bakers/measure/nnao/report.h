// The rows of `nook evaluate nnao`, their means over scenes, and the tables of docs/nnao.md.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bakers/measure/nnao/comparison.h"

namespace nook::measure {

// One object a row. border_bias is the mean of AO - truth within 20 px of any border less that inside;
// ratio_to_nnao the time over that of nnao with 64 taps.
nlohmann::ordered_json nnao_rows(const Comparison& comparison, const std::string& scene,
                                 const std::string& resolution, const std::string& gpu);

// One object a blurred method: the mean of AO - truth in the bands of each border, outermost first, and
// inside.
nlohmann::ordered_json nnao_border_rows(const Comparison& comparison, const std::string& scene);

// For each method, number of taps and blur the mean of every number over the scenes, as a row of the scene
// "mean". All scenes have the same methods in the same order.
nlohmann::ordered_json nnao_mean_rows(const nlohmann::ordered_json& rows);

// Markdown: blurred mse by scene with its mean, then the means of every column.
std::string nnao_markdown(const nlohmann::ordered_json& rows);

}  // namespace nook::measure
