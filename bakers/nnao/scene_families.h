// Procedural training scenes with one family of shapes in each file: seeded, about the size of a room, in
// metres, y up, the floor at y = 0. They are not made to look good; they contain the occlusions that images
// contain.
#pragma once

#include <cstdint>

#include "bakers/nnao/solids.h"

namespace nook::bake::nnao {

struct Box {
  Vec3 low, high;
};

struct TrainingScene {
  TriangleSoup soup;
  Box cameras;  // the camera is inside
  Box subject;  // the camera looks at a point inside
};

TrainingScene make_clutter(Random& random);      // heaps of boxes, balls and drums
TrainingScene make_dining_room(Random& random);  // a laid table, shell chairs, lamps
TrainingScene make_foliage(Random& random);      // grass, bushes, trees
TrainingScene make_hull(Random& random);         // bodies of plates with wings and engines
TrainingScene make_machinery(Random& random);    // pipes, tanks, wheels, cables
TrainingScene make_people(Random& random);       // figures with fingers, standing and sitting
TrainingScene make_railings(Random& random);     // fences, grilles, bars
TrainingScene make_room(Random& random);         // walls, furniture, shelves
TrainingScene make_stairs(Random& random);       // flights, landings, balustrades
TrainingScene make_terrain(Random& random);      // rolling ground, rocks, caves

inline constexpr std::uint32_t family_count = 10;
// The families alternate.
TrainingScene make_scene(std::uint64_t seed, std::uint32_t index);

// Pieces that several families use.
void add_floor(TriangleSoup& soup, float half_width);
void add_table(TriangleSoup& soup, const Mat3x4& frame, Random& random);
void add_chair(TriangleSoup& soup, const Mat3x4& frame, Random& random);
void add_crate_or_ball(TriangleSoup& soup, Vec3 foot, float size, Random& random);
// Upright bars between two points on the ground, with a rail on top.
void add_fence(TriangleSoup& soup, Vec3 from, Vec3 to, float height, float spacing, float thickness);

}  // namespace nook::bake::nnao
