// What the crowd takes from the light of the ground, channel by channel, as a texture laid on it.
#pragma once

#include <glad/gl.h>

#include <vector>

#include "samples/crowd/body_spheres.h"
#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/renderer.h"

namespace crowd {

class FloorLight {
 public:
  // Covers the ground round all places.
  FloorLight(const GladGLContext& gl, const Hero& hero, const std::vector<Placement>& places,
             const Light& light);
  ~FloorLight();
  FloorLight(const FloorLight&) = delete;
  FloorLight& operator=(const FloorLight&) = delete;

  // A sphere that covers the share f of a point's hemisphere takes f rho of its irradiance, rho being the
  // lobes' radiance from its direction over their mean in the hemisphere; several together leave exp(-sum).
  FloorAo draw(const std::vector<Bones>& poses);

 private:
  glm::vec3 ratio(const glm::vec3& direction) const;

  const GladGLContext& gl_;
  std::vector<BodySphere> body_;
  std::vector<glm::vec3> ratio_;  // of directions above the ground: azimuth, then cosine to the normal
  FloorAo floor_;
};

}  // namespace crowd
