// The frame of every bake. It runs the bake on the requested threads and writes the file and its report.
#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "bakers/job/bake_identity.h"
#include "bakers/job/baked_file.h"
#include "bakers/tool/command_files.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {

class Command;
struct BakeSurvey;

// The options of every bake.
struct BakeOptions {
  std::filesystem::path output;
  std::filesystem::path depfile, cache;  // empty: none
  bool prints_key = false;
  std::string isa;  // empty: as the environment says
  const BakeSurvey* survey = nullptr;
};

// Adds -o, --depfile, --cache, --print-key and --isa.
void add_bake_options(Command command, BakeOptions& options);

struct BakeCommand {
  const CommonOptions& common;
  const BakeOptions& baking;
  CommandFiles files;  // inputs and outputs of the bake, without its output, report and depfile
  std::string stopped = "stopped; nothing was written";  // for the user who pressed Ctrl-C
  // The bake makes more than its file and report, such as pictures, which a cache does not hold.
  bool makes_more = false;
  bool reads_images = false;  // of its glTF files
  // A time limit makes the result depend on the speed of the machine; such a result stays out of the cache.
  bool has_time_limit = false;
};

struct BakeOutput {
  std::vector<std::byte> file;
  std::string report;  // the text of the report's file
  std::string table;   // shown to the user
};

// A bake whose inputs are read and checked, before its work.
struct PreparedBake {
  bake::BakeIdentity identity;
  std::function<BakeOutput()> perform;  // owns all that it needs
};

// The report is {"rows": [row]} with the row of the file's report. The table leaves out keys that only a file
// needs.
BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report = {});

// Prepares the bake, and performs it unless a cache holds its result. Writes the report, the depfile and the
// file, in this order, and prints the table. It checks before the work begins that files and folders can be
// written, and that none would replace a file that is read. A stopped bake writes nothing. With --print-key
// it only prepares the bake and prints its key. With a survey it calls the survey and does nothing else.
void run_bake(BakeCommand command, const std::function<PreparedBake()>& prepare);

}  // namespace nook::tool
