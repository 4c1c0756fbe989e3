// The frame of every evaluation: it runs on the requested threads and hands over a report.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "bakers/tool/common_options.h"
#include "bakers/tool/distinct_files.h"

namespace nook::tool {

// Writes what evaluate returns to the report's file, and its rows as a table to the output stream. A report
// or a folder of pictures that cannot be written, or one that would replace a file that is read, is known
// before the work begins. files: what evaluate reads and writes, without the report.
void run_evaluation(const CommonOptions& options, CommandFiles files,
                    const std::function<nlohmann::ordered_json()>& evaluate);

}  // namespace nook::tool
