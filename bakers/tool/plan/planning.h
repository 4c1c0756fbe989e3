// `nook plan` as a function. `nook build` also calls it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "bakers/tool/command_line.h"

namespace nook::tool::plan {

struct PlanOptions {
  std::filesystem::path manifest, build, cache, report;
  std::string isa;
  std::uint32_t threads = 0, bake_threads = 0;
  bool dry_run = false, quiet = false;
};

void add_plan_options(Command command, PlanOptions& options);

struct PlanResult {
  std::filesystem::path build;  // absolute
  std::size_t to_run = 0;       // bakes
};

// Reads the manifest, decides for every bake whether it must run, copies results from the cache, and writes
// the files of plan_files.h. Prints what must run and why. Changes the working directory of the process to
// the manifest's folder. The bakes run there too.
PlanResult make_plan(const PlanOptions& options);

}  // namespace nook::tool::plan
