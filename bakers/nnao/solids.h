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

// Frames: standing_frame is turned about y, and the other has any rotation, uniformly distributed.
Mat3x4 standing_frame(Vec3 origin, float angle);
Mat3x4 tumbled_frame(Vec3 origin, Random& random);

// Computes two axes perpendicular to a direction.
void axes_across(Vec3 direction, Vec3& u, Vec3& v);

}  // namespace nook::bake::nnao
