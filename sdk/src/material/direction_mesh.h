// Interpolation between sampled directions: the Delaunay triangulation of their points in the parabolic map.
// The map is stereographic, so that circles stay circles and these are the Delaunay triangles of the sphere
// too.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/material/parabolic.h"

namespace nook::material {

// The three nearest directions around a direction and their weights, which are non-negative and sum to 1.
struct DirectionMix {
  std::array<std::uint16_t, 3> index{};
  std::array<float, 3> weight{1, 0, 0};
};

class DirectionMesh {
 public:
  // Requires at least one direction, and directions that are min_distance apart.
  explicit DirectionMesh(std::span<const Vec3> directions, Memory* memory = default_memory());

  // Interpolates linearly inside the triangle that contains the point, and continuously everywhere. Beyond
  // the outermost directions the nearest point between them is used. `hint` is kept between calls with points
  // near each other.
  DirectionMix locate(ParabolicPoint p, std::size_t& hint) const;

  std::size_t triangle_count() const { return triangles_.size(); }

 private:
  struct Point {
    double x = 0, y = 0;
  };
  using Triangle = std::array<std::uint16_t, 3>;  // counter-clockwise
  using Edge = std::array<std::uint16_t, 2>;

  void triangulate(std::size_t directions);
  void insert(std::uint16_t point);
  void find_border();
  bool circle_holds(const Triangle& t, const Point& p) const;
  bool weights_in(const Triangle& t, const Point& p, std::array<double, 3>& weight) const;

  Vector<Point> points_;
  Vector<Triangle> triangles_;
  Vector<Edge> border_;  // outermost edges; a chain where there are no triangles
  Vector<Edge> cavity_;  // the edges of the hole of an insertion
};

// Returns the cosine of a light beyond the outermost sampled lights, divided by the cosine of the nearest
// direction between them, `mix`. With it, light fades to 0 at the horizon. Between the samples it is 1.
inline float low_light_share(std::span<const Vec3> lights, const DirectionMix& mix, float z) {
  ParabolicPoint nearest{};
  for (int i = 0; i < 3; ++i) {
    const ParabolicPoint p = to_parabolic(lights[mix.index[i]]);
    nearest.x += mix.weight[i] * p.x;
    nearest.y += mix.weight[i] * p.y;
  }
  const float cosine = from_parabolic(nearest).z;
  // Between the samples both cosines are equal up to rounding.
  return z < cosine - 1e-5f ? std::max(z, 0.0f) / cosine : 1.0f;
}

}  // namespace nook::material
