// Adds simple solids for the training scenes to a triangle soup. World space, metres, y up.
#pragma once

#include <array>
#include <vector>

#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

void add_triangle(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c);
void add_quad(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c, Vec3 d);

// Adds a box from -half to half in the frame's axes.
void add_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half);
// Adds an axis-aligned box from `low` to `high`.
void add_block(TriangleSoup& soup, Vec3 low, Vec3 high);

// Adds a box from `low` to `high` in the frame's axes.
void add_block(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high);
// Adds a box with bevelled edges. `bevel` is the width that is cut off.
void add_bevelled_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float bevel);
// Adds a sack or a pillow. `softness` goes from near 0 (a box with round edges) to 1 (an ellipsoid).
void add_cushion(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float softness, int sides = 24);

// Adds a truncated cone with caps.
void add_cylinder(TriangleSoup& soup, Vec3 from, Vec3 to, float radius_from, float radius_to, int sides = 12);
inline void add_rod(TriangleSoup& soup, Vec3 from, Vec3 to, float radius, int sides = 8) {
  add_cylinder(soup, from, to, radius, radius, sides);
}
// Adds a rod with round ends.
void add_capsule(TriangleSoup& soup, Vec3 from, Vec3 to, float radius, int sides = 12);

// Adds an ellipsoid with the semi-axes `half` along the frame's axes.
void add_ellipsoid(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, int sides = 16);

// Adds a thin surface of revolution about the frame's y axis, without caps. `profile` lists points (radius,
// height).
void add_lathe(TriangleSoup& soup, const Mat3x4& frame, const std::vector<std::array<float, 2>>& profile,
               int sides = 18);

// Adds a ring in the frame's x-z plane.
void add_torus(TriangleSoup& soup, const Mat3x4& frame, float radius, float tube_radius, int sides = 20);

// Adds a tube with open ends along a path of at least two points. Each point has a radius.
void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, const std::vector<float>& radius,
              int sides = 8);
void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, float radius, int sides = 8);

// Extrudes a profile along the frame's x axis, from 0 to `length`. The profile lists points (out, up); `out`
// is along the frame's z axis. The ends are closed.
void add_moulding(TriangleSoup& soup, const Mat3x4& frame, float length,
                  const std::vector<std::array<float, 2>>& profile);

// Adds a sheet of columns x rows quads. point(u, v) returns its points, with u and v from 0 to 1.
template <class Point>
void add_sheet(TriangleSoup& soup, int columns, int rows, const Point& point) {
  const auto first = std::uint32_t(soup.position.size());
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i)
      soup.position.push_back(point(float(i) / float(columns), float(j) / float(rows)));
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      const auto a = first + std::uint32_t(j * (columns + 1) + i), b = a + std::uint32_t(columns + 1);
      soup.triangle.push_back({a, a + 1, b + 1});
      soup.triangle.push_back({a, b + 1, b});
    }
}

// Returns frames at `origin`. standing_frame turns the frame about y. tumbled_frame draws a uniformly
// distributed rotation.
Mat3x4 standing_frame(Vec3 origin, float angle);
Mat3x4 tumbled_frame(Vec3 origin, Random& random);

// `moved` moves the frame's origin along the frame's own axes.
Mat3x4 moved(const Mat3x4& frame, Vec3 by);
Mat3x4 tilted(const Mat3x4& frame, float angle);
Mat3x4 rolled(const Mat3x4& frame, float angle);

// Returns a uniformly distributed unit vector.
Vec3 any_direction(Random& random);

// Computes two axes perpendicular to a direction.
void axes_across(Vec3 direction, Vec3& u, Vec3& v);

}  // namespace nook::bake::nnao
