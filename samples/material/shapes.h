// Surfaces with texture coordinates that do not run together anywhere: a sphere would need poles. Metres, y
// up.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace material {

struct Vertex {
  glm::vec3 position, normal;
  glm::vec3 tangent;  // unit, along u, at right angles to the normal; v runs along cross(normal, tangent)
  glm::vec2 uv;       // in tiles
};

struct Shape {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;  // triangles, counter-clockwise from outside
};

// A ring, a knotted tube, a vase that is open above, and a cloth in folds, side by side round the origin.
// tile_m: side of a tile; closed surfaces take the nearest whole number of tiles round.
std::vector<Shape> make_shapes(float tile_m);

}  // namespace material
