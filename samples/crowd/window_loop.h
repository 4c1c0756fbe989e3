// The crowd in a window, with controls; until the window is closed.
#pragma once

#include <span>

#include "crowd_scene.h"
#include "layout.h"
#include "options.h"

namespace crowd {

void run_window(platform::Context& context, const Hero& hero, std::span<const unsigned char> model,
                const std::vector<Placement>& places, Renderer& renderer, const Options& options);

}  // namespace crowd
