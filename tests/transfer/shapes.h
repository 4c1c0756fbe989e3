// Shapes of the tests of radiance transfer, y up, in metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sdk/src/core/vec.h"

namespace nook::transfer::test {

struct Shape {
  std::vector<Vec3> position, normal;
  std::vector<std::array<float, 2>> uv;
  std::vector<std::array<std::uint32_t, 3>> triangle;
};

// A square of `across` x `across` vertices around the origin at the height y, whose normal is +y. u grows
// along +x and v along -z.
Shape plane(float side_m, std::uint32_t across, float tiles, float y = 0);

// A ball of latitude and longitude, with seams.
Shape ball(Vec3 centre, float radius_m, std::uint32_t around);

// A tube of radius 0.085 around the (2, 3) torus knot whose radius is 0.3 (1 + 0.45 cos 3a) and whose height
// is 0.25 + 0.135 sin 3a, over a plane. The tube has along x around vertices with seams, and the plane has
// across x across: 5,440 in all by default.
Shape knot_over_plane(std::uint32_t along = 240, std::uint32_t around = 16, std::uint32_t across = 40);

// Cloth that hangs over a ball: a square of 96 x 96 vertices, flat on top of the ball, in waves where it
// falls, over a plane.
Shape draped_cloth();

void append(Shape& shape, const Shape& other);

// Returns the bytes of a .glb file with one primitive.
std::vector<std::byte> glb_of(const Shape& shape);

}  // namespace nook::transfer::test
