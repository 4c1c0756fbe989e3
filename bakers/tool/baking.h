// The frame of every bake: it runs on the requested threads and hands over the file and its report.
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
  CommandFiles files;  // what the bake reads and writes, without the output and the report
  std::string stopped = "stopped; nothing was written";  // for the user who pressed Ctrl-C
};

struct BakeOutput {
  std::vector<std::byte> file;
  std::string report;  // the text of the report's file
  std::string table;   // what the user sees
};

// The report is {"rows": [row]} of the file's report. The table leaves out the keys that only a file wants.
BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report = {});

// Writes what bake returns to the output and the report's file, and prints the table. You hear of a file or a
// folder of pictures that cannot be written, or of one that would replace a file that is read, before the
// work begins. A bake that is stopped writes nothing.
void run_bake(BakeCommand command, const std::function<BakeOutput()>& bake);

}  // namespace nook::tool
