// The options of `nook-lab evaluate nnao`, and the protocols that use them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bakers/lab/nnao/measured_view.h"
#include "bakers/tool/common_options.h"

namespace nook::tool {
class Command;
}

namespace nook::lab {

// The scenes with their cameras and radii, as words of the command line that are not parsed yet.
struct SceneWords {
  std::vector<std::filesystem::path> files;
  bool thin = false;
  bake::ImportOptions reading;
  std::vector<std::string> cameras;  // [NAME:]ox,oy,oz,tx,ty,tz,fov; without NAME, applies to every scene
  std::vector<std::string> radii;    // [NAME:]metres
};

// The settings of `nook-lab evaluate nnao` from the command line.
struct EvaluateNnaoOptions {
  tool::CommonOptions common;
  TruthSettings truth;
  SceneWords scenes;
  std::filesystem::path views;                // a list of scenes with their cameras, instead of files
  std::filesystem::path folder;               // folder of the list's scenes
  std::vector<std::string> sources;           // sources of the list to use; empty: all
  std::vector<std::filesystem::path> frames;  // recorded frames, instead of scenes
  bool sized = false, rays_given = false;
  std::filesystem::path references, network, images, markdown;
  std::vector<std::string> methods;  // empty: all
  std::vector<std::string> ratios;   // METHOD:TAPS,METHOD:TAPS
  bool raw = true;
  bool bent = false;                          // bent normals and specular occlusion instead of AO
  bool temporal = false;                      // means over frames instead of single frames
  std::vector<std::filesystem::path> movers;  // walking characters, instead of scenes
  std::string clip;                           // clip of the movers; empty: the first walk clip
  float walk_speed = 1.4f;                    // metres per second
  std::uint32_t placed_cameras = 3;
  float max_radius_px = 0;
  float intensity = 1;  // intensity of the library's pass
  std::string tune;     // a baseline's name, or all; empty: no tuning
};

// Adds the options to the command. `options` must stay valid until the command has run.
void add_options(tool::Command command, EvaluateNnaoOptions& options);

// Parses WxH in pixels. Throws ToolError (bad arguments).
void parse_size(const std::string& text, TruthSettings& truth);

// Throws ToolError (bad arguments) if options exclude each other, or if there is nothing to evaluate.
void check_options(const EvaluateNnaoOptions& options);

// Measures the AO of single frames with every method and number of taps. Like all protocols below, it returns
// a report, and throws ToolError or Failure (cancelled).
nlohmann::ordered_json evaluate_views(EvaluateNnaoOptions& options);

// Measures bent normals and specular occlusion.
nlohmann::ordered_json evaluate_bent_normals(EvaluateNnaoOptions& options);

// Measures temporally accumulated AO while the camera moves.
nlohmann::ordered_json evaluate_sequences(EvaluateNnaoOptions& options);

// Measures temporally accumulated AO while a skinned character walks.
nlohmann::ordered_json evaluate_movers(const EvaluateNnaoOptions& options);

// Finds the best settings of baselines on training scenes, and prints the rows of their table.
nlohmann::ordered_json evaluate_tuning(const EvaluateNnaoOptions& options);

}  // namespace nook::lab
