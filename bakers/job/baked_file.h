// The result of a bake, and its report of progress.
#pragma once

#include <nook/nook_bake.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nook::bake {

struct BakedFile {
  std::vector<std::byte> model;  // of a .nook file
  std::string report;            // JSON
};

// Returns false to stop.
using StageReport = std::function<bool(nook_bake_stage stage, std::size_t done, std::size_t total)>;

}  // namespace nook::bake
