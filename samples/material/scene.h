// Where the camera and the lights are, frame by frame.
#pragma once

#include <glm/glm.hpp>

namespace material {

struct View {
  glm::mat4 view_projection{1};
  glm::vec3 eye{0};            // metres
  glm::vec3 key_direction{0};  // unit, to a distant light
  glm::vec3 fill_direction{0};
};

// The key light goes once round for `turns` 0 to 1, the camera swings to and fro.
View view_at(float turns, float aspect);

}  // namespace material
