// Procedural training scenes. Each source file has one family of shapes. Scenes are seeded, in metres, with y
// up and the floor at y = 0. They do not look good, but they contain the kinds of occlusion that real images
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

  // The size of the scene's objects relative to a room's. Camera distances scale with it.
  float size = 1;
};

TrainingScene make_arcade(Random& random);       // columns, arches, cornices, coffers
TrainingScene make_armour(Random& random);       // bodies with armour plates, scales, belts
TrainingScene make_clutter(Random& random);      // heaps of boxes, balls and drums
TrainingScene make_dining_room(Random& random);  // a laid table, shell chairs, lamps
TrainingScene make_drapery(Random& random);      // curtains, cloths on tables, folded stacks
TrainingScene make_foliage(Random& random);      // grass, bushes, trees
TrainingScene make_forest(Random& random);       // trunks, branches, ivy, ferns; distant woods
TrainingScene make_furniture(Random& random);    // drawers, bookcases, sofas, beds, door frames
TrainingScene make_hall(Random& random);         // corridors and halls with beams, ducts and pipes
TrainingScene make_hull(Random& random);         // plated hulls with wings and engines
TrainingScene make_machinery(Random& random);    // pipes, tanks, wheels, cables
TrainingScene make_parts(Random& random);        // small parts: gears, screws, housings
TrainingScene make_people(Random& random);       // figures with fingers, standing and sitting
TrainingScene make_railings(Random& random);     // fences, grilles, bars
TrainingScene make_relief(Random& random);       // walls of brick, stone, boards, tiles, carvings
TrainingScene make_room(Random& random);         // walls, furniture, shelves
TrainingScene make_stacks(Random& random);       // pallets, sacks, barrels, crates, racks
TrainingScene make_stairs(Random& random);       // flights, landings, balustrades
TrainingScene make_statues(Random& random);      // smooth bodies with folds, on plinths
TrainingScene make_street(Random& random);       // facades, kerbs, cars, lamp posts
TrainingScene make_terraces(Random& random);     // landscapes with steps, blocks, towns from above
TrainingScene make_terrain(Random& random);      // rolling ground, rocks, caves
TrainingScene make_vehicles(Random& random);     // cars, bicycles, trailers
TrainingScene make_wires(Random& random);        // nets, chain link, cables, scaffolds

inline constexpr std::uint32_t family_count = 24;
const char* family_name(std::uint32_t family);

// Consecutive indices go through the families in turn. The first round contains plain scenes. In later
// rounds, some scenes also contain objects of another family. Some are scaled by 0.2 to 5, together with
// their cameras.
TrainingScene make_scene(std::uint64_t seed, std::uint32_t index);

// Copies a group of small objects that are close together in `guest` onto surfaces of `host`.
void add_guests(TrainingScene& host, const TrainingScene& guest, Random& random);
void scale_scene(TrainingScene& scene, float factor);

// Objects that several families use.
void add_floor(TriangleSoup& soup, float half_width);
void add_table(TriangleSoup& soup, const Mat3x4& frame, Random& random);
void add_chair(TriangleSoup& soup, const Mat3x4& frame, Random& random);
void add_crate_or_ball(TriangleSoup& soup, Vec3 foot, float size, Random& random);
// Adds a car that stands on y = 0 and points along +z.
void add_car(TriangleSoup& soup, const Mat3x4& frame, Random& random);
// Adds upright bars between two points on the ground, with a rail on top.
void add_fence(TriangleSoup& soup, Vec3 from, Vec3 to, float height, float spacing, float thickness);

}  // namespace nook::bake::nnao
