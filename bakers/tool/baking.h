// The frame of bakes of a single file: it runs on the requested threads and hands over the file and its
// report.
#pragma once

#include <filesystem>
#include <functional>

#include "bakers/job/baked_file.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/distinct_files.h"

namespace nook::tool {

// Writes what bake returns to `output` and the report's file, and its row as a table to the output stream. A
// file or a folder of pictures that cannot be written, or one that would replace a file that is read, is
// known before the work begins, and a bake that is stopped writes nothing. files: what bake reads and writes,
// without the output and the report.
void run_bake(const CommonOptions& options, const std::filesystem::path& output, CommandFiles files,
              const std::function<bake::BakedFile()>& bake);

}  // namespace nook::tool
