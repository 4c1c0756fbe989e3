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
  CommandFiles files;  // inputs and outputs of the bake, without its output, report and depfile
  std::string stopped = "stopped; nothing was written";  // the message after Ctrl-C
  // True if the bake also writes other outputs than its file and report, such as pictures. A cache cannot
  // store these.
  bool makes_more = false;
  bool reads_images = false;  // whether it reads the images of its glTF files
  // True if the bake has a time limit. Then the result depends on the speed of the machine, and it is not
  // stored in the cache.
  bool has_time_limit = false;
};

struct BakeOutput {
  std::vector<std::byte> file;
  std::string report;  // the text of the report's file
  std::string table;   // shown to the user
};

// A bake with inputs that are read and checked. The work has not started.
struct PreparedBake {
  bake::BakeIdentity identity;
  std::function<BakeOutput()> perform;  // owns everything that it uses
};

// Makes a report with one row: {"rows": [row]}, where the row is file.report. The table for the user leaves
// out the keys in only_in_report.
BakeOutput one_row(bake::BakedFile file, std::initializer_list<const char*> only_in_report = {});

// Prepares the bake, and performs it unless the cache has its result. Writes the report, the depfile and the
// file, in this order, and prints the table. Before the work begins, checks that files and folders can be
// written, and that no output would replace an input. A stopped bake writes nothing. With --print-key, only
// prepares the bake and prints its key. With a survey, calls the survey and does nothing else.
void run_bake(BakeCommand command, const std::function<PreparedBake()>& prepare);

}  // namespace nook::tool
