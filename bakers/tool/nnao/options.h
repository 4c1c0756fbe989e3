// The options of `nook evaluate nnao`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bakers/measure/nnao/scene_views.h"
#include "bakers/tool/common_options.h"
#include "bakers/tool/nnao/scenes.h"

namespace nook::tool {

class Command;

// The settings of `nook evaluate nnao` from the command line.
struct EvaluateNnaoOptions {
  CommonOptions common;
  measure::TruthSettings truth;
  SceneWords scenes;
  std::filesystem::path views;                // a list of scenes with their cameras, instead of files
  std::filesystem::path folder;               // of the list's scenes
  std::vector<std::string> sources;           // of the list; empty: all
  std::vector<std::filesystem::path> frames;  // recorded ones, instead of scenes
  bool sized = false, rays_given = false;
  std::filesystem::path references, network, images, markdown;
  std::vector<std::string> methods;  // empty: all
  std::vector<std::string> ratios;   // METHOD:TAPS,METHOD:TAPS
  bool raw = true;
  bool bent = false;                          // bent normals and specular occlusion in place of AO
  bool temporal = false;                      // means over frames in place of single ones
  std::vector<std::filesystem::path> movers;  // characters that walk, instead of scenes
  std::string clip;                           // of the movers; empty: the first that walks
  float walk_speed = 1.4f;                    // metres a second
  std::uint32_t placed_cameras = 3;
  float max_radius_px = 0;
  float intensity = 1;  // of the library's pass
  std::string tune;     // a baseline's name, or all; empty: no tuning
};

// Adds the options to the command. They stay where they are until the command has run.
void add_options(Command command, EvaluateNnaoOptions& options);

// Reads WxH, pixels. Throws ToolError (bad arguments).
void parse_size(const std::string& text, measure::TruthSettings& truth);

// Throws ToolError (bad arguments) where options exclude each other or no work is named.
void check_options(const EvaluateNnaoOptions& options);

}  // namespace nook::tool
