// nook evaluate nnao --frame: recorded frames of hosts, replayed.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "platform/platform.h"

namespace nook::tool {

struct FrameWords {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> methods;  // NAME or NAME:TAPS; empty: the library's rows and the oracle
  std::vector<std::byte> network;    // a file of `nook train nnao`, measured as well; empty: none
  std::filesystem::path images;      // empty: no pictures
  bool quiet = false;
};

// Returns a report with rows for each frame, then their means. Throws ToolError that names the file.
nlohmann::ordered_json evaluate_frames(platform::Context& context, const FrameWords& words);

}  // namespace nook::tool
