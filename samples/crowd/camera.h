// Cameras: an orbit round the crowd, and a close view of one group.
#pragma once

#include <glm/glm.hpp>

namespace crowd {

struct Camera {
  glm::vec3 eye_ws{0, 1.6f, 4};
  glm::vec3 target_ws{0, 0.9f, 0};
  float fov_rad = 0.6f;  // vertical
};

glm::mat4 view_from_world(const Camera& camera);
glm::mat4 clip_from_view(const Camera& camera, float aspect);
glm::mat4 clip_from_world(const Camera& camera, float aspect);
// turn in [0, 1) goes once round a crowd whose members stand within radius_m of the origin.
Camera orbit(float radius_m, float turn);

}  // namespace crowd
