// The shapes of a debug view as plain lists, from what the public interface tells of a scene. World space,
// metres; colours are linear.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "samples/crowd/crowd_scene.h"
#include "samples/crowd/debug_view.h"

namespace crowd {

struct Ball {
  glm::vec3 centre_ws;
  float radius_m;
  glm::vec3 colour;
};

struct Line {
  glm::vec3 from_ws;
  float from_width_px;
  glm::vec3 to_ws;
  float to_width_px;
  glm::vec3 colour;
};

struct DebugShapes {
  std::vector<Ball> spheres, key_points;
  std::vector<Line> normals, links;
};

// The characters by their distance to a point, at most `count` of them.
std::vector<std::uint32_t> nearest_characters(const CrowdScene& scene, const glm::vec3& to_ws,
                                              std::uint32_t count);

// Shadows at key points are those of the scene's last update on the CPU.
DebugShapes debug_shapes(const CrowdScene& scene, const DebugView& view, const glm::vec3& eye_ws);

// The colour of a level of detail, of which 0 is the finest.
glm::vec3 level_colour(std::uint32_t level);
// The colour of a shadow at a key point, from dark blue at 0 to yellow at kFullShadow and above.
inline constexpr float kFullShadow = 0.25f;
glm::vec3 shadow_colour(float shadow);

}  // namespace crowd
