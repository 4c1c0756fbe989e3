// Lights the surfaces of a stage three times: without occlusion, with Nook's occlusion, and with ray-traced
// occlusion. In all three, the sun and its shadow are ray traced, which stands in for the engine's own
// shadows. Only the light of the sky differs.
#pragma once

#include <cstdint>

#include "samples/showcase/surfaces.h"

namespace showcase {

// Irradiance of each pixel.
struct Irradiance {
  std::vector<glm::vec3> sun;                    // the same in all pictures
  std::vector<glm::vec3> off, nook, ray_traced;  // of the sky
};

struct Rays {
  std::uint32_t sky = 32, sun = 16;  // for each pixel
};

Irradiance light_surfaces(const Stage& stage, const Cast& cast, const Surfaces& surfaces, const Rays& rays);

// The displayed values of a picture in [0, 1], with the stage's exposure. Rows run from bottom to top.
std::vector<glm::vec3> developed(const Stage& stage, const Surfaces& surfaces,
                                 const std::vector<glm::vec3>& sun, const std::vector<glm::vec3>& sky);

}  // namespace showcase
