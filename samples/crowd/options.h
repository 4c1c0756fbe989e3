// The command line of the crowd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "samples/crowd/debug_view.h"

namespace crowd {

struct Options {
  // Without a .glb this is the built-in character, and without a .nook its model is baked here.
  std::filesystem::path hero_glb, hero_nook;
  std::string context = "egl";
  std::uint32_t characters = 100, neighbours = 4, frames = 4, seed = 1;
  int width_px = 1280, height_px = 720;
  int tier = 0;  // 33, 43, or 0 for the best that the context has
  std::filesystem::path out = "out/crowd", report;
  std::filesystem::path cache;
  std::filesystem::path record;  // empty: frames are recorded by the window's button alone, into out
  std::vector<std::filesystem::path> lights;  // probes (.nook) or maps of the environment (.hdr, .exr)
  bool probe_light = true;                    // the frames have the first of the lights, or the built-in sky
  bool screen_space = true, sheets = true, quiet = false;
  bool measure_world = false;
  float lod_error = 0;  // AO, rms at 10 m from the camera; 0 keeps full detail
  DebugView debug;      // over the frames, and what a window shows first
  std::string bake;     // a preset that a window bakes the model with at its start; empty: none
  // Empty, or where a window writes a picture of itself before it closes.
  std::filesystem::path window_picture;
};

// Fills options. Returns false with exit_code set if the program should end at once.
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

}  // namespace crowd
