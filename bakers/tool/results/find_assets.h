// Finds the baked files below a folder, and what bakes left beside them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "bakers/tool/results/task_end.h"

namespace nook::tool {

struct FoundAssets {
  std::map<std::string, AssetFiles> assets;   // by their paths in the folder, without the extension
  std::map<std::string, std::string> faults;  // folders in it that cannot be read, with the reason
};

// A log belongs to the model beside it, or to the model that `nook plan` names it after.
// Leaves out names that begin with a dot, and the entries of a cache, whose names are keys. Follows links to
// files and not to folders. Throws ToolError (bad input) if `folder` cannot be read.
FoundAssets find_assets(const std::filesystem::path& folder);

}  // namespace nook::tool
