// Where the camera and the lights are in each frame.
#pragma once

#include <glm/glm.hpp>

namespace material {

struct View {
  glm::mat4 view_projection{1};
  glm::vec3 eye{0};            // world space, metres
  glm::vec3 key_direction{0};  // unit, to a distant light
  glm::vec3 fill_direction{0};
};

// While `turns` goes from 0 to 1, the key light moves once around, and the camera swings back and forth.
View view_at(float turns, float aspect);

}  // namespace material
