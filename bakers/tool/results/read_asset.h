// Reads one baked file, its report and its log, and judges them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bakers/measure/report/overview.h"
#include "bakers/tool/results/task_end.h"

namespace nook::tool {

// `name` is the asset's path in `folder`, without the extension. If a file cannot be read, the returned asset
// says so. Returns nothing if there is neither a model nor another sign of a bake, for example if there is
// only a .json file of another kind. You may call this on several threads at the same time.
std::optional<report::Asset> read_asset(const std::filesystem::path& folder, const std::string& name,
                                        AssetFiles files);

}  // namespace nook::tool
