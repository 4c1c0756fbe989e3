// The light of the crowd. It holds lobes, of which the last may be a sun, and the values that passes and
// shaders need.
#pragma once

#include <nook/nook_probe.h>

#include <glm/glm.hpp>
#include <vector>

namespace crowd {

struct Light {
  // If has_sun is set, the last lobe is a sun, which is drawn as a cone; the other lobes are soft light.
  explicit Light(std::vector<nook_lobe> all_lobes, bool has_sun = false);

  // The radiance of the lobes in a unit direction, not below 0.
  glm::vec3 radiance(const glm::vec3& direction) const;

  std::vector<nook_lobe> lobes, soft;
  glm::vec3 to_sun{0, 1, 0};
  float sun_degrees = 0;            // full angle; 0: there is no sun
  glm::vec3 soft_up{0}, sun_up{0};  // the irradiance of open ground
  float exposure = 1;               // of radiance, for a surface that faces up
};

// A clear sky over warm ground, and a low, hazy sun.
Light sky();

}  // namespace crowd
