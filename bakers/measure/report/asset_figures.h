// How good a baked file is, by the errors and verdicts that its bake stored.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/measure/report/overview.h"

namespace nook::report {

struct AssetFigures {
  AssetState state = AssetState::unmeasured;
  std::optional<double> over_limit;
  std::string figure, notes;  // as in Asset
};

// Returns the kind for the reader, such as "character". facts: the file's row of `nook inspect`.
std::string asset_kind(const nlohmann::ordered_json& facts);

// report: the row of the report of the file's bake; null: there is none, and what only reports hold is not
// measured.
AssetFigures asset_figures(const nlohmann::ordered_json& facts, const nlohmann::ordered_json& report);

// Returns the duration of the bake from its report.
std::optional<double> baking_seconds(const nlohmann::ordered_json& report);

// The rows of the page's table about limits.
std::vector<LimitRow> asset_limits();

}  // namespace nook::report
