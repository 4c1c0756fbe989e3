// Options of every subcommand.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bakers/import/import_options.h"

namespace nook::tool {

class Command;

struct CommonOptions {
  std::uint32_t threads = 0;  // 0: all cores
  std::uint64_t seed = 1;
  std::filesystem::path report;  // empty: none
  bool quiet = false;
};

void add_common_options(Command command, CommonOptions& options);

// The options of every command that reads glTF.
void add_import_options(Command command, bake::ImportOptions& options);

}  // namespace nook::tool
