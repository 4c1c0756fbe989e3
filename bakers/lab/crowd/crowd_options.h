// The command-line options of nook-lab-crowd.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/lab/crowd/debug_shapes.h"
#include "samples/crowd/crowd_scene.h"

namespace crowd::lab {

struct Options {
  // If the .glb is not given, the built-in character is used. If the .nook is not given, the program bakes
  // the model itself.
  std::filesystem::path hero_glb, hero_nook;
  std::string context = "egl";
  CrowdSize crowd;
  std::uint32_t frames = 4, seed = 1;
  int width_px = 1280, height_px = 720;
  std::filesystem::path out = "out/crowd", report;
  std::filesystem::path cache;
  std::filesystem::path record;
  std::vector<std::filesystem::path> lights;  // probes (.nook) or environment maps (.hdr, .exr)
  bool probe_light = true;                    // lights the frames with the first light or the built-in sky
  bool screen_space = true, sheets = true, quiet = false;
  bool measure_world = false;
  float lod_error = 0;  // allowed rms error of AO at 10 m from the camera; 0 keeps full detail
  DebugView debug;      // drawn over the frames
};

// Fills `options`. Returns false if the program should exit at once, with `exit_code`.
bool parse_options(int argc, char** argv, Options& options, int& exit_code);

}  // namespace crowd::lab
