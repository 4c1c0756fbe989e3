#include "samples/material/material_scene.h"

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace material {

View view_at(float turns, float aspect) {
  const float angle = 2 * glm::pi<float>() * turns, swing = 0.45f * std::sin(angle);
  View view;
  view.eye = glm::vec3(3.4f * std::sin(swing), 0.75f + 0.25f * std::cos(angle), 3.4f * std::cos(swing));
  view.view_projection = glm::perspective(glm::radians(36.0f), aspect, 0.1f, 20.0f) *
                         glm::lookAt(view.eye, glm::vec3(0, -0.12f, 0), glm::vec3(0, 1, 0));
  view.key_direction =
      glm::normalize(glm::vec3(std::sin(angle + 0.6f), 0.9f, 0.35f + 0.8f * std::cos(angle + 0.6f)));
  view.fill_direction = glm::normalize(glm::vec3(-0.6f, 0.5f, 0.8f));
  return view;
}

}  // namespace material
