// The options of `nook bake probe`, for both kinds of input.
#pragma once

#include <array>
#include <filesystem>

#include "bakers/tool/baking.h"
#include "bakers/tool/probe_options.h"
#include "sdk/src/core/vec.h"

namespace nook::tool {

struct BakeProbeOptions {
  CommonOptions common;
  ProbeOptions probe;
  BakeOptions baking;
  std::filesystem::path input;

  // For one map:
  std::filesystem::path picture;
  std::string sampling = "automatic";
  std::uint32_t samples = 0;  // for a map or for each probe of a grid; 0: 1,048,576 for a map, and up to
                              // 65,536 for a probe of a grid

  // For a scene:
  std::array<std::uint32_t, 3> grid{0, 0, 0};
  std::filesystem::path light;
  BoxArgument box;
  double error = 0.01, preview_every_s = 0;
  std::uint32_t max_bounces = ~0u;
  bool no_textures = false;
  bake::ImportOptions reading;
  std::string direct = "all";
  bool walls = false;
  std::uint32_t training_paths = 2048;
};

PreparedBake prepare_probe_of_map(const BakeProbeOptions& options);
PreparedBake prepare_probe_grid(const BakeProbeOptions& options);

}  // namespace nook::tool
