// The networks of `nook evaluate nnao`.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "sdk/src/nnao/network_file.h"

namespace nook::tool {

// The embedded network, and that of --network.
struct Networks {
  nook::nnao::Network embedded;
  std::vector<std::byte> file;  // empty: none
  nook::nnao::Network other;
};

// file: that of --network; empty: none. Throws ToolError that names it.
Networks read_networks(const std::filesystem::path& file);

// Returns the given network's name in tables; empty without one.
std::string other_name(const Networks& networks);

}  // namespace nook::tool
