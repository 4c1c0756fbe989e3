// Trip counts of the loops of the shaders, for the frames of the cost table.
#pragma once

namespace nook::measure::trips {

// A character of a crowd: the bench's body in the midst of others.
inline constexpr int group_size = 64;  // threads of a group, and spheres that it stages at a time
inline constexpr double spheres = 130;
inline constexpr double tiles = 3;  // of group_size spheres, the last one partly filled
inline constexpr double spheres_in_tile = spheres / tiles;
inline constexpr double casters = 4;        // neighbours
inline constexpr double exact_spheres = 1;  // the ground
inline constexpr double influence_pairs = 4;
inline constexpr double light_lobes = 12;  // of an instance's light

// The screen-space pass.
inline constexpr double sides = 2;

// The world pass at a pixel of the crowd sample with 100 characters.
inline constexpr double bodies_of_tile = 100;
inline constexpr double parts_of_body = 0.08;
inline constexpr double casters_of_part = 0.2;
// At half resolution the lists of near bodies have fewer, more of which a pixel evaluates.
inline constexpr double near_bodies_of_tile = 9;
inline constexpr double parts_of_near_body = 0.6;
// The share of pixels that lie between characters so that no texel of far bodies is on their surface.
inline constexpr double alone = 0.004;

// A capture: a cube map of faces of 64 texels becomes 12 lobes, which are one group of sums.
inline constexpr int capture_face_size = 64;  // texels
inline constexpr int capture_rows = 6 * capture_face_size;
inline constexpr int capture_factors = 12 / 4;

}  // namespace nook::measure::trips
