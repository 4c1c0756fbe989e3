// The options of every subcommand.
#pragma once

#include <cstdint>
#include <filesystem>

#include "bakers/import/linked_files.h"

namespace nook::tool {

class Command;

struct CommonOptions {
  std::uint32_t threads = 0;  // 0: all cores
  std::uint64_t seed = 1;
  std::filesystem::path report;  // empty: none
  bool quiet = false;
};

void add_common_options(Command command, CommonOptions& options);

// The choice of every command that reads glTF.
void add_linked_files_option(Command command, bake::LinkedFiles& linked);

}  // namespace nook::tool
