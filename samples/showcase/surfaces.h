// Draws the surfaces of a stage, and runs Nook's screen-space pass and world pass on them.
#pragma once

#include <vector>

#include "platform/platform.h"
#include "samples/showcase/cast.h"

namespace showcase {

enum class Kind : std::uint8_t { sky, prop, actor };

// What the camera sees. Rows run from bottom to top.
struct Pixel {
  glm::vec3 position_ws;
  glm::vec3 normal_ws;  // for the sky, the direction of view
  glm::vec3 albedo;
  Kind kind = Kind::sky;
  std::uint16_t actor = 0;      // an index, for actors
  glm::vec3 directional_ao{1};  // for actors
  glm::vec3 screen_open{1};     // for props: the open share of the sky
};

struct Surfaces {
  int width_px = 0, height_px = 0;
  std::vector<Pixel> pixels;
};

Surfaces draw_surfaces(platform::Context& context, const Stage& stage, const Cast& cast, int width_px,
                       int height_px);

}  // namespace showcase
