// The share of the ground's light that the crowd leaves, for each channel, as a texture that lies on the
// ground.
#pragma once

#include <glad/gl.h>

#include <vector>

#include "samples/crowd/layout.h"
#include "samples/crowd/light.h"
#include "samples/crowd/renderer.h"

namespace crowd {

// A part of a body, for what the body takes from the ground's light.
struct BodySphere {
  std::uint32_t bone;
  glm::vec3 centre_m;  // in the rest pose
  float radius_m;
};

class FloorLight {
 public:
  // The texture covers the ground round all places.
  FloorLight(const GladGLContext& gl, const Hero& hero, const std::vector<Placement>& places,
             const Light& light);
  ~FloorLight();
  FloorLight(const FloorLight&) = delete;
  FloorLight& operator=(const FloorLight&) = delete;

  // A sphere that covers the share f of a point's hemisphere takes the share f rho of its irradiance. rho is
  // the lobes' radiance from the sphere's direction, divided by their mean over the hemisphere. Several
  // spheres together leave exp(-sum).
  FloorTexture draw(const std::vector<Bones>& poses);

 private:
  glm::vec3 ratio(const glm::vec3& direction) const;

  const GladGLContext& gl_;
  std::vector<BodySphere> body_;
  std::vector<glm::vec3> ratio_;  // rho above the ground, by azimuth and then by the cosine to the normal
  FloorTexture floor_;
};

}  // namespace crowd
