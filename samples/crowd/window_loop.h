// The crowd in a window with controls, debug views, and its model's file, which is loaded again when it
// changes and can be baked anew.
#pragma once

#include <filesystem>
#include <vector>

#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/options.h"

namespace crowd {

// The things that the window shows. The light of a probe is for all characters; it may be null.
struct WindowStage {
  platform::Context& context;
  const Hero& hero;
  const std::vector<Placement>& places;
  Renderer& renderer;
  const Light* light;
  std::filesystem::path model_path;
};

// Returns when the window is closed. model holds the bytes of the model's file.
void run_window(const WindowStage& stage, std::vector<unsigned char> model, const Options& options);

}  // namespace crowd
