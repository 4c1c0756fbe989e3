// What every subcommand takes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace CLI {
class App;
}

namespace nook::tool {

struct CommonOptions {
  std::uint32_t threads = 0;  // 0: all cores
  std::uint64_t seed = 1;
  std::filesystem::path report;  // empty: none
  bool quiet = false;
};

void add_common_options(CLI::App& command, CommonOptions& options);

}  // namespace nook::tool
