// Runs any bake on the requested threads, and writes its file and its report.
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
  std::string isa;  // empty: use the environment variable
  const BakeSurvey* survey = nullptr;
};

// Adds -o, --depfile, --cache, --print-key and --isa.
void add_bake_options(Command command, BakeOptions& options);

struct BakeCommand {
  const CommonOptions& common;
  const BakeOptions& baking;
  CommandFiles files;  // the other files that the bake reads and writes, without the baked file, its report
                       // and its depfile
  std::string stopped = "stopped; nothing was written";  // the message after Ctrl-C
  // True if the bake also writes outputs that a cache cannot store, such as pictures. The cache only stores
  // the baked file and the report.
  bool makes_more = false;
  bool reads_images = false;  // true if the bake reads the images of its glTF files
  // True if the bake has a time limit. Then the result depends on the speed of the machine, and it is not
  // stored in the cache.
  bool has_time_limit = false;
};

struct BakeOutput {
  std::vector<std::byte> file;
  std::string report;  // the text of the report's file
  std::string table;   // shown to the user
};

// A bake whose inputs have been read and checked, but whose work has not started.
struct PreparedBake {
  bake::BakeIdentity identity;
  std::function<BakeOutput()> perform;  // owns everything that it uses
};

// Makes a report with one row, {"rows": [row]}, where the row is file.report. The table that the user sees
// does not contain the keys in only_in_report.
BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report = {});

// Prepares the bake. If the cache has the result, uses it, and otherwise performs the bake. Then writes the
// report, the depfile and the baked file, in this order, and prints the table. Before the work begins, checks
// that files and folders can be written, and that no output would replace an input. If the user stops the
// bake, nothing is written. With --print-key, only prepares the bake and prints its key. With a survey, only
// calls the survey.
void run_bake(BakeCommand command, const std::function<PreparedBake()>& prepare);

}  // namespace nook::tool
