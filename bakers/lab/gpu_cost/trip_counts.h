// Trip counts of the loops of the shaders, for the frames of the cost table.
#pragma once

namespace nook::lab::trips {

// A crowd's character is the bench's body in the midst of others.
inline constexpr int group_size = 64;  // threads of a group, and spheres that it stages at a time
inline constexpr double spheres = 130;
inline constexpr double bones_of_thread = 65.0 / group_size;
inline constexpr double rows_of_bone = 3;
inline constexpr double pose_modes = 40;  // of clips
inline constexpr double steps_to_rotation = 3;
inline constexpr double tiles = 3;  // tiles of group_size spheres, the last one partly filled
inline constexpr double spheres_in_tile = spheres / tiles;
inline constexpr double casters = 4;        // neighbours
inline constexpr double exact_spheres = 1;  // the ground
inline constexpr double influence_pairs = 4;
inline constexpr double light_lobes = 12;  // in an instance's light

// The screen-space pass.
inline constexpr double sides = 2;

// The world pass at a texel of the crowd sample with 100 characters at 1920 x 1080, as counted in its report.
// Lists hold all bodies whose reach covers a tile.
inline constexpr double bodies_of_tile = 100;
inline constexpr double parts_of_body = 0.08;
inline constexpr double casters_of_part = 0.2;
// At half resolution by draws, the lists of near bodies are shorter, and a pixel evaluates a larger share of
// them.
inline constexpr double near_bodies_of_tile = 9;
inline constexpr double parts_of_near_body = 0.6;
// For groups of threads. A group reads bodies_read of a list at a time and keeps some. The numbers are
// world_counts of the report: tests, capsules of limbs and casters over the tests, far_tests.
inline constexpr int bodies_read = 32;
inline constexpr double near_bodies_of_group = 1.01;
inline constexpr double parts_of_group_body = 5.56;
inline constexpr double casters_of_group_part = 0.195;
inline constexpr double far_bodies_of_group = 26.8;
// Shares of threads: parts that count as one capsule; far bodies in reach; surfaces without a normal.
inline constexpr double merged_parts = 0.96;
inline constexpr double far_bodies_in_reach = 0.91;
inline constexpr double no_normal = 0;
// The share of pixels between characters without a texel of far bodies on their surface.
inline constexpr double alone = 0.004;

// Steps to the next surface along an axis where both neighbours belong to characters, for pixels without the
// host's normal. One pixel in a hundred takes two steps.
inline constexpr double steps_past_characters = 0.02;

// A capture turns a cube map with faces of 64 texels into 12 lobes, which are one group of sums.
inline constexpr int capture_face_size = 64;  // texels
inline constexpr int capture_rows = 6 * capture_face_size;
inline constexpr int capture_factors = 12 / 4;

}  // namespace nook::lab::trips
