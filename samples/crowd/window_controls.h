// The controls of the window: their settings and their readings.
#pragma once

#include <nook/nook.hpp>
#include <optional>
#include <string>

#include "samples/crowd/camera.h"
#include "samples/crowd/debug_view.h"
#include "samples/crowd/model_bake.h"

struct GLFWwindow;

namespace crowd {

struct Controls {
  bool ao = true, probe_light = true, self = true, neighbours = true, ground = true, screen_space = true,
       playing = true;
  float intensity = 1.0f, key = 0.5f;
  int link_count = 4;
  int tier = 0;  // 33, 43, or 0 for the best
  float lod_error = 0;
  float turn = 0, height = 0.35f, distance_m = 8;
  DebugView debug;
  int preset = NOOK_BAKE_PRESET_DRAFT;

  // Buttons that were pressed in the last frame.
  bool record = false, bake = false, cancel = false;

  std::uint32_t terms() const;  // a sum of NOOK_TERM_ values
  Camera camera() const;
};

// The readings of the last frame beside the controls.
struct Readings {
  int tier = 0;
  bool have_light = false;
  double update_ms = 0;
  std::uint32_t links = 0, culled_links = 0;
  std::uint32_t characters = 0;
  std::string recorded;  // the last recorded frame, or an empty text
  std::string error_text;
  std::string model_name, model_text;      // the model's file, and what happened to it last
  std::optional<nook_bake_progress> bake;  // of a bake that runs
};

// ImGui in a window.
class Gui {
 public:
  explicit Gui(GLFWwindow* window);
  ~Gui();
  Gui(const Gui&) = delete;
  Gui& operator=(const Gui&) = delete;

  // Draws the controls over the picture and takes the user's changes.
  void draw(Controls& controls, const Readings& readings);
};

}  // namespace crowd
