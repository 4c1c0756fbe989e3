// The command line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace material {

struct Options {
  std::vector<std::filesystem::path>
      files;  // .nook, drawn one after the other with the same views and lights
  std::string context = "egl";
  std::uint32_t frames = 6;
  int width_px = 960, height_px = 540;
  float tile_m = 0.16f;  // side of a tile on the shapes
  std::filesystem::path out = "out/material", report;
  bool quiet = false;
};

// Fills options; returns false with exit_code set where the program should end at once.
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

}  // namespace material
