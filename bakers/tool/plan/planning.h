// nook plan as a function, which nook build also calls.
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

// Reads the manifest, decides about every bake, copies results of the cache and writes the files of
// plan_files.h. Prints what must run and why. Changes the process's folder to the manifest's, in which the
// bakes run as well.
PlanResult make_plan(const PlanOptions& options);

}  // namespace nook::tool::plan
