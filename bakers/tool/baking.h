// The frame of every bake. It runs the bake on the requested threads and writes the file and its report.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>

#include "bakers/job/baked_file.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

struct BakeCommand {
  const CommonOptions& common;
  std::filesystem::path output;
  CommandFiles files;  // inputs and outputs of the bake, without its output and report
  std::string stopped = "stopped; nothing was written";  // for the user who pressed Ctrl-C
};

struct BakeOutput {
  std::vector<std::byte> file;
  std::string report;  // the text of the report's file
  std::string table;   // shown to the user
};

// The report is {"rows": [row]} with the row of the file's report. The table leaves out keys that only a file
// needs.
BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report = {});

// Writes what bake returns to the output and the report's file, and prints the table. It checks before the
// work begins that files and folders can be written, and that none would replace a file that is read. A
// stopped bake writes nothing.
void run_bake(BakeCommand command, const std::function<BakeOutput()>& bake);

}  // namespace nook::tool
