// nook report --all DIR: one page about every baked file of a folder.
#pragma once

#include <filesystem>

#include "bakers/tool/common_options.h"

namespace nook::tool {

struct ReportAllOptions {
  std::filesystem::path folder, output;
  std::filesystem::path before;  // the page to compare with; empty: the one that `output` replaces
};

// Throws ToolError for a folder that cannot be read or holds nothing baked. A broken file becomes a row.
void report_all(const ReportAllOptions& options, const CommonOptions& common);

}  // namespace nook::tool
