// Draws recorded frames again. `nook evaluate nnao` runs this function. nook-lab also runs it and adds its
// own methods.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/measure/nnao/frame_comparison.h"
#include "platform/platform.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::tool {

// The embedded network, and the network file that --network names.
struct Networks {
  nook::nnao::Network embedded;
  std::vector<std::byte> file;  // empty: none
  nook::nnao::Network other;
};

// `file` is the path from --network, or empty. Throws ToolError that names the file.
Networks read_networks(const std::filesystem::path& file);

// Returns an OpenGL 3.3 context without a display.
std::unique_ptr<platform::Context> make_context();

struct FrameWords {
  std::vector<std::filesystem::path> files;
  std::vector<std::string> methods;  // NAME or NAME:TAPS; if empty, uses the library's rows and the oracle
  // Bytes of a network file from `nook train nnao`, which is measured as well; empty: none.
  std::vector<std::byte> network;
  std::filesystem::path images;  // empty: no pictures
  bool quiet = false;
};

// Returns additional methods for one frame.
using FrameMethods = std::function<std::vector<measure::FrameMethod>(const GladGLContext&)>;

// Returns a report with the rows of each frame, followed by rows of means. `further` may be null. If a file
// cannot be read, throws ToolError that names it.
nlohmann::ordered_json evaluate_frames(platform::Context& context, const FrameWords& words,
                                       const FrameMethods& further);

}  // namespace nook::tool
