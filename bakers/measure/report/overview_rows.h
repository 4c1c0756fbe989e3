// Converts between the assets and the JSON rows of the page about all baked files. templates/overview.js
// reads the same columns.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/measure/report/overview.h"

namespace nook::report {

inline constexpr const char* overview_data_id = "results";
inline constexpr int overview_format = 1;

nlohmann::ordered_json overview_data(const Overview& overview);

}  // namespace nook::report
