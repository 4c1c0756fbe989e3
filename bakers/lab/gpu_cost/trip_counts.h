// Trip counts of shader loops, for the frames of the cost table.
#pragma once

namespace nook::lab::trips {

// Characters: the body of the benchmark, in the middle of a crowd.
inline constexpr int group_size = 64;  // threads of a group, and spheres that it loads at a time
inline constexpr double spheres = 130;
inline constexpr double bones_of_thread = 65.0 / group_size;
inline constexpr double rows_of_bone = 3;
inline constexpr double pose_modes = 40;  // number of pose modes of baked clips
inline constexpr double steps_to_rotation = 3;
inline constexpr double tiles = 3;  // tiles of group_size spheres, the last one partly filled
inline constexpr double spheres_in_tile = spheres / tiles;
inline constexpr double casters = 4;        // neighbours
inline constexpr double exact_spheres = 1;  // the ground
inline constexpr double influence_pairs = 4;
inline constexpr double light_lobes = 12;  // lobes in an instance's light

// The screen-space pass.
inline constexpr double sides = 2;

// The world pass, per texel, in the crowd sample with 100 characters at 1920 x 1080. The values are from the
// sample's report. The list of a tile contains all bodies whose range of influence overlaps the tile.
inline constexpr double bodies_of_tile = 100;
inline constexpr double parts_of_body = 0.08;
inline constexpr double casters_of_part = 0.2;
// At half resolution with draw calls instead of compute, the lists of near bodies are shorter, and a pixel
// evaluates a larger share of each list.
inline constexpr double near_bodies_of_tile = 9;
inline constexpr double parts_of_near_body = 0.6;
// The world pass with thread groups. A group reads `bodies_read` bodies of a list at a time, and keeps those
// that affect its pixels. The values are from `world_counts` in the sample's report. They are `tests`, the
// counts for limb capsules and casters divided by `tests`, and `far_tests`.
inline constexpr int bodies_read = 32;
inline constexpr double near_bodies_of_group = 1.01;
inline constexpr double parts_of_group_body = 5.56;
inline constexpr double casters_of_group_part = 0.195;
inline constexpr double far_bodies_of_group = 26.8;
// For each of three branches, the share of threads that take it: parts that are merged into one capsule, far
// bodies in range, and surfaces without a normal.
inline constexpr double merged_parts = 0.96;
inline constexpr double far_bodies_in_reach = 0.91;
inline constexpr double no_normal = 0;
// Among the pixels between characters, the share for which no texel of the far bodies' image lies on the same
// surface.
inline constexpr double alone = 0.004;

// For pixels without a normal from the host: the mean number of steps along an axis to the next surface, if
// both neighbours belong to characters. One pixel in a hundred takes two steps.
inline constexpr double steps_past_characters = 0.02;

// A capture converts a cube map with faces of 64 x 64 texels into 12 lobes. The 12 lobes are one group of
// sums.
inline constexpr int capture_face_size = 64;  // texels
inline constexpr int capture_rows = 6 * capture_face_size;
inline constexpr int capture_factors = 12 / 4;

}  // namespace nook::lab::trips
