// Judges a baked file by the errors and verdicts that its bake stored.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/measure/report/overview.h"

namespace nook::report {

struct AssetFigures {
  AssetState state = AssetState::unmeasured;
  std::optional<double> over_limit;
  std::string figure, notes;  // the same meaning as in Asset
};

// Returns the kind of the file as the page shows it, such as "character". `facts` is the file's row from
// `nook inspect`.
std::string asset_kind(const nlohmann::ordered_json& facts);

// `report` is the row of the report that the file's bake wrote. If it is null, values that only reports
// contain are treated as not measured.
AssetFigures asset_figures(const nlohmann::ordered_json& facts, const nlohmann::ordered_json& report);

// Returns the duration of the bake from its report.
std::optional<double> baking_seconds(const nlohmann::ordered_json& report);

// Returns the rows of the page's table of limits.
std::vector<LimitRow> asset_limits();

}  // namespace nook::report
