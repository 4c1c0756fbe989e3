// Surfaces whose texture coordinates do not run together anywhere, as they would at the poles of a sphere.
// Metres, y up.
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

// A ring, a knotted tube, a vase that is open at the top, and a cloth in folds, side by side round the
// origin. A tile's side has tile_m. Closed surfaces take the nearest whole number of tiles round.
std::vector<Shape> make_shapes(float tile_m);

}  // namespace material
