// Reads one baked file, its report and its log, and judges them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bakers/measure/report/overview.h"
#include "bakers/tool/results/task_end.h"

namespace nook::tool {

// name: the asset's path in `folder`, without the extension. A file that cannot be read becomes an asset that
// says so. Returns nothing if there is neither a model nor a trace of a bake, such as a .json file of another
// kind. Safe to call on several threads at a time.
std::optional<report::Asset> read_asset(const std::filesystem::path& folder, const std::string& name,
                                        AssetFiles files);

}  // namespace nook::tool
