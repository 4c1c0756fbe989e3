// Finds the baked files below a folder, and the reports, logs and unfinished files beside them.
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

// A log belongs to the model beside it. A log from `nook plan` belongs to the model that it is named after.
// Leaves out names that begin with a dot, and the entries of a cache, which are named by keys. Follows links
// to files but not to folders. Throws ToolError (bad input) if `folder` cannot be read.
FoundAssets find_assets(const std::filesystem::path& folder);

}  // namespace nook::tool
