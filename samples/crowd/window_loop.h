// The crowd in a window with controls.
#pragma once

#include <span>

#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/options.h"

namespace crowd {

// Returns when the window is closed. The light of a probe is for all characters; it may be null.
void run_window(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
                const std::vector<Placement>& places, Renderer& renderer, const Light* light,
                const Options& options);

}  // namespace crowd
