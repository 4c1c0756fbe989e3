// A body as a few dozen spheres, for what it takes from the light of the ground.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

struct BodySphere {
  std::uint32_t bone;
  glm::vec3 centre_m;  // rest space
  float radius_m;
};

// Along each bone a chain of spheres as thick as the vertices that follow it; fingers and the like are left
// out.
std::vector<BodySphere> body_spheres(const Hero& hero);

}  // namespace crowd
