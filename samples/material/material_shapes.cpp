#include "samples/material/material_shapes.h"

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

namespace material {
namespace {

using Surface = std::function<glm::vec3(float s, float t)>;  // s and t go from 0 to 1

struct Closed {
  bool s = false, t = false;
};

constexpr float turn = 2 * glm::pi<float>();

// The mean length of the lines along s, or along t.
float mean_length(const Surface& surface, bool along_s) {
  constexpr int lines = 16, steps = 128;
  float sum = 0;
  for (int line = 0; line < lines; ++line) {
    const float fixed = (float(line) + 0.5f) / lines;
    const auto at = [&](int i) {
      const float moving = float(i) / steps;
      return along_s ? surface(moving, fixed) : surface(fixed, moving);
    };
    for (int i = 0; i < steps; ++i) sum += glm::distance(at(i), at(i + 1));
  }
  return sum / lines;
}

// Normals point along cross(d/ds, d/dt).
Shape make_shape(const Surface& surface, Closed closed, int columns, int rows, float tile_m) {
  glm::vec2 tiles(mean_length(surface, true) / tile_m, mean_length(surface, false) / tile_m);
  if (closed.s) tiles.x = std::max(std::round(tiles.x), 1.0f);
  if (closed.t) tiles.y = std::max(std::round(tiles.y), 1.0f);
  Shape shape;
  constexpr float h = 1e-3f;
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column) {
      const float s = float(column) / float(columns), t = float(row) / float(rows);
      const glm::vec3 along_s = surface(s + h, t) - surface(s - h, t);
      const glm::vec3 along_t = surface(s, t + h) - surface(s, t - h);
      const glm::vec3 normal = glm::normalize(glm::cross(along_s, along_t));
      const glm::vec3 tangent = glm::normalize(along_s - normal * glm::dot(normal, along_s));
      shape.vertices.push_back({surface(s, t), normal, tangent, tiles * glm::vec2(s, t)});
    }
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const auto a = std::uint32_t(row * (columns + 1) + column), c = a + std::uint32_t(columns) + 1;
      for (const std::uint32_t index : {a, a + 1, c + 1, a, c + 1, c}) shape.indices.push_back(index);
    }
  return shape;
}

// A tube around a closed curve.
Surface tube(std::function<glm::vec3(float)> curve, float radius_m) {
  return [curve, radius_m](float s, float t) {
    constexpr float h = 1e-3f;
    const glm::vec3 forward = glm::normalize(curve(s + h) - curve(s - h));
    const glm::vec3 side = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0.15f)));
    const glm::vec3 up = glm::cross(side, forward);
    return curve(s) + radius_m * (std::cos(turn * t) * side - std::sin(turn * t) * up);
  };
}

}  // namespace

std::vector<Shape> make_shapes(float tile_m) {
  const Surface ring = tube(
      [](float s) {
        return glm::vec3(-1.05f + 0.36f * std::cos(turn * s), 0.36f * std::sin(turn * s) + 0.02f, 0.15f);
      },
      0.16f);
  const Surface knot = tube(
      [](float s) {
        const float a = turn * s, r = 0.3f * (1 + 0.45f * std::cos(3 * a));
        return glm::vec3(0.02f + r * std::cos(2 * a), r * std::sin(2 * a), 0.25f + 0.16f * std::sin(3 * a));
      },
      0.085f);
  const Surface vase = [](float s, float t) {
    const float radius = 0.25f + 0.09f * std::sin(5.2f * t + 0.3f) + 0.06f * t * t;
    return glm::vec3(1.0f - radius * std::cos(turn * s), -0.5f + 1.0f * t,
                     0.1f + radius * std::sin(turn * s));
  };
  const Surface cloth = [](float s, float t) {
    const float x = 3.6f * (s - 0.5f), z = 1.9f * (0.5f - t);
    return glm::vec3(x, -0.62f + 0.05f * std::sin(5 * x + 2 * z) * std::cos(4 * z - x), z);
  };
  return {make_shape(ring, {true, true}, 160, 64, tile_m), make_shape(knot, {true, true}, 400, 40, tile_m),
          make_shape(vase, {true, false}, 128, 96, tile_m), make_shape(cloth, {}, 160, 96, tile_m)};
}

}  // namespace material
