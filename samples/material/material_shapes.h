// Surfaces whose texture coordinates have no singular points, such as the poles of a sphere. Metres, y up.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace material {

struct Vertex {
  glm::vec3 position, normal;
  // A unit vector along u, at right angles to the normal. v runs along cross(normal, tangent).
  glm::vec3 tangent;
  glm::vec2 uv;  // in tiles
};

struct Shape {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // triangles, counter-clockwise from outside
};

// Makes a ring, a knotted tube, a vase that is open at the top, and a folded cloth, side by side around the
// origin. A tile is `tile_m` metres wide. Around closed surfaces, the number of tiles is rounded to an
// integer.
std::vector<Shape> make_shapes(float tile_m);

}  // namespace material
