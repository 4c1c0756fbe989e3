// The command line of the material sample.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace material {

struct Options {
  // .nook files, which are drawn one after the other with the same views and lights.
  std::vector<std::filesystem::path> files;
  std::string context = "egl";
  std::uint32_t frames = 6;
  int width_px = 960, height_px = 540;
  float tile_m = 0.16f;       // the side of a tile on the shapes
  std::uint32_t fetches = 2;  // along each pixel
  bool is_one_sided = false;  // true: the insides of the surfaces are not drawn
  std::filesystem::path out = "out/material", report;
  bool quiet = false;
};

// Fills options. Returns false with exit_code set if the program should end at once.
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

}  // namespace material
