// Cameras and their matrices.
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace crowd {

struct Camera {
  glm::vec3 eye_ws{0, 1.6f, 4};
  glm::vec3 target_ws{0, 0.9f, 0};
  float fov_rad = 0.6f;  // vertical
};

inline glm::mat4 view_from_world(const Camera& camera) {
  return glm::lookAt(camera.eye_ws, camera.target_ws, glm::vec3(0, 1, 0));
}

inline glm::mat4 clip_from_view(const Camera& camera, float aspect) {
  const float distance_m = glm::length(camera.eye_ws - camera.target_ws);
  return glm::perspective(camera.fov_rad, aspect, 0.1f, 60.0f + 4 * distance_m);
}

inline glm::mat4 clip_from_world(const Camera& camera, float aspect) {
  return clip_from_view(camera, aspect) * view_from_world(camera);
}

// Returns a camera that moves once around the crowd while `turn` goes from 0 to 1. The crowd's members stand
// within radius_m of the origin.
inline Camera orbit(float radius_m, float turn) {
  const float angle = turn * glm::two_pi<float>() + 0.5f;
  const float distance_m = 0.85f * radius_m + 3.5f;
  Camera camera;
  camera.eye_ws = {distance_m * std::sin(angle), 1.4f + 0.2f * distance_m, distance_m * std::cos(angle)};
  // The target is a little in front of the middle, so that the picture does not cut off the front rows.
  camera.target_ws =
      0.02f * radius_m * glm::vec3(std::sin(angle), 0, std::cos(angle)) + glm::vec3(0, 0.3f, 0);
  camera.fov_rad = 0.5f;
  return camera;
}

}  // namespace crowd
