// What every evaluation does: runs on the asked-for threads and hands over a report.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "bakers/tool/common_options.h"

namespace nook::tool {

// Writes what evaluate returns to the report's file, and its rows as a table to the output stream. A report
// that cannot be written is known before the work begins.
void run_evaluation(const CommonOptions& options, const std::function<nlohmann::ordered_json()>& evaluate);

}  // namespace nook::tool
