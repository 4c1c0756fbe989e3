// The crowd in a window, with controls; until the window is closed.
#pragma once

#include <span>

#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/options.h"

namespace crowd {

// light: of a probe, for all characters; null: none.
void run_window(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
                const std::vector<Placement>& places, Renderer& renderer, const Light* light,
                const Options& options);

}  // namespace crowd
