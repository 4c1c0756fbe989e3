// `nook report --all DIR` makes one page about all baked files of a folder.
#pragma once

#include <filesystem>

#include "bakers/tool/common_options.h"

namespace nook::tool {

struct ReportAllOptions {
  std::filesystem::path folder, output;
  std::filesystem::path before;  // the page to compare with; empty: the page that `output` replaces
};

// Throws ToolError if the folder cannot be read or contains no baked files. A broken file gets a row on the
// page.
void report_all(const ReportAllOptions& options, const CommonOptions& common);

}  // namespace nook::tool
