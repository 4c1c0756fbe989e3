// Finds all baked files in a folder and its subfolders, and the reports, logs and unfinished files that
// belong to them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "bakers/tool/results/task_end.h"

namespace nook::tool {

struct FoundAssets {
  std::map<std::string, AssetFiles> assets;   // the key is the path in the folder, without the extension
  std::map<std::string, std::string> faults;  // subfolders that cannot be read, with the reason
};

// A log belongs to the model with the same name in the same folder. A log from `nook plan` belongs to the
// model that it is named after. Ignores names that begin with a dot, and the entries of a cache, whose names
// are keys. Follows links to files but not to folders. Throws ToolError (bad input) if `folder` cannot be
// read.
FoundAssets find_assets(const std::filesystem::path& folder);

}  // namespace nook::tool
