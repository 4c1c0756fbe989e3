// Simple solids for the training scenes, which are added to a triangle soup. World space, metres, y up.
#pragma once

#include <array>
#include <vector>

#include "bakers/raytrace/random.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/vec.h"

namespace nook::bake::nnao {

void add_triangle(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c);
void add_quad(TriangleSoup& soup, Vec3 a, Vec3 b, Vec3 c, Vec3 d);

// A box from -half to half in the frame's axes.
void add_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half);
// A box along the axes from low to high.
void add_block(TriangleSoup& soup, Vec3 low, Vec3 high);

// The same in the axes of a frame.
void add_block(TriangleSoup& soup, const Mat3x4& frame, Vec3 low, Vec3 high);
// A box whose edges are cut off at a width of bevel.
void add_bevelled_box(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float bevel);
// A sack or a pillow: from the ellipsoid (softness 1) to a box with round edges (softness near 0).
void add_cushion(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, float softness, int sides = 24);

// A cone frustum with caps.
void add_cylinder(TriangleSoup& soup, Vec3 from, Vec3 to, float radius_from, float radius_to, int sides = 12);
inline void add_rod(TriangleSoup& soup, Vec3 from, Vec3 to, float radius, int sides = 8) {
  add_cylinder(soup, from, to, radius, radius, sides);
}
// A rod with round ends.
void add_capsule(TriangleSoup& soup, Vec3 from, Vec3 to, float radius, int sides = 12);

// The unit sphere in the frame's axes times half.
void add_ellipsoid(TriangleSoup& soup, const Mat3x4& frame, Vec3 half, int sides = 16);

// A thin sheet of revolution about the frame's y axis through points (radius, height), without caps.
void add_lathe(TriangleSoup& soup, const Mat3x4& frame, const std::vector<std::array<float, 2>>& profile,
               int sides = 18);

// A ring in the frame's x-z plane.
void add_torus(TriangleSoup& soup, const Mat3x4& frame, float radius, float tube_radius, int sides = 20);

// A tube of one radius for each point of a path of two points or more, with open ends.
void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, const std::vector<float>& radius,
              int sides = 8);
void add_tube(TriangleSoup& soup, const std::vector<Vec3>& path, float radius, int sides = 8);

// A profile (out, up) that is drawn along the frame's x axis from 0 to length; out is the frame's z axis. The
// ends are closed.
void add_moulding(TriangleSoup& soup, const Mat3x4& frame, float length,
                  const std::vector<std::array<float, 2>>& profile);

// A sheet of columns x rows quads through the points of a function of (u, v), each from 0 to 1.
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

// Frames: standing_frame is turned about y, and the other has any rotation, uniformly distributed.
Mat3x4 standing_frame(Vec3 origin, float angle);
Mat3x4 tumbled_frame(Vec3 origin, Random& random);

// The frame with its origin moved along its own axes.
Mat3x4 moved(const Mat3x4& frame, Vec3 by);
Mat3x4 tilted(const Mat3x4& frame, float angle);
Mat3x4 rolled(const Mat3x4& frame, float angle);

// A unit vector, uniformly distributed.
Vec3 any_direction(Random& random);

// Computes two axes perpendicular to a direction.
void axes_across(Vec3 direction, Vec3& u, Vec3& v);

}  // namespace nook::bake::nnao
