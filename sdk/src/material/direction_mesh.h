// Interpolates between sampled directions with a Delaunay triangulation of their points in the parabolic map.
// The map is a stereographic projection, which maps circles to circles. So the triangulation is also the
// Delaunay triangulation on the sphere.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sdk/src/core/containers.h"
#include "sdk/src/material/parabolic.h"

namespace nook::material {

// The three sampled directions around a direction, and their weights. Weights are non-negative and sum to 1.
struct DirectionMix {
  std::array<std::uint16_t, 3> index{};
  std::array<float, 3> weight{1, 0, 0};
};

class DirectionMesh {
 public:
  // Pass at least one direction. Directions must be at least min_distance apart.
  explicit DirectionMesh(std::span<const Vec3> directions, Memory* memory = default_memory());

  // Interpolates linearly inside the triangle that contains the point. A point outside the mesh is moved to
  // the nearest point on the mesh, so the result is continuous everywhere. `hint` is the triangle of the last
  // call, where the search starts. If successive points are close to each other, pass the same variable
  // again, to make the search faster.
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
  Vector<Edge> border_;  // the outer border; a chain of edges if there are no triangles
  Vector<Edge> cavity_;  // the border of the hole that an insertion leaves
};

// Returns a factor that fades light to 0 between the lowest sampled lights and the horizon. The factor is z /
// c, where `z` is the cosine of the light, and c the cosine of the nearest direction on the mesh, which `mix`
// describes. For directions inside the mesh, the factor is 1.
inline float low_light_share(std::span<const Vec3> lights, const DirectionMix& mix, float z) {
  ParabolicPoint nearest{};
  for (int i = 0; i < 3; ++i) {
    const ParabolicPoint p = to_parabolic(lights[mix.index[i]]);
    nearest.x += mix.weight[i] * p.x;
    nearest.y += mix.weight[i] * p.y;
  }
  const float cosine = from_parabolic(nearest).z;
  // Inside the mesh, both cosines are equal except for rounding.
  return z < cosine - 1e-5f ? std::max(z, 0.0f) / cosine : 1.0f;
}

}  // namespace nook::material
