// The crowd in a window with controls. It loads the model's file again whenever the file changes, so that an
// artist sees the result of a new bake.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/places.h"

namespace crowd {

struct WindowRequest {
  std::filesystem::path model;    // need not exist yet
  std::filesystem::path picture;  // empty, or where the window writes a picture of itself before it closes
  int link_count = 4;
  std::vector<std::string> debug;  // debug views that are on at the start: spheres, links
  int bodies = 1;                  // number of bodies whose spheres are shown
};

// Returns when the window is closed.
void run_window(platform::Context& context, const Hero& hero, const std::vector<Placement>& places,
                CrowdScene& scene, const Light& light, const WindowRequest& request);

}  // namespace crowd
