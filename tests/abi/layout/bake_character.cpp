#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_range, 8);
NOOK_AT(nook_range, first, 0);
NOOK_AT(nook_range, count, 4);

NOOK_SIZE(nook_bake_source_desc, 160);
NOOK_AT(nook_bake_source_desc, struct_size, 0);
NOOK_AT(nook_bake_source_desc, type, 4);
NOOK_AT(nook_bake_source_desc, next, 8);
NOOK_AT(nook_bake_source_desc, path, 16);
NOOK_AT(nook_bake_source_desc, bytes, 24);
NOOK_AT(nook_bake_source_desc, byte_count, 32);
NOOK_AT(nook_bake_source_desc, positions, 40);
NOOK_AT(nook_bake_source_desc, indices, 48);
NOOK_AT(nook_bake_source_desc, joints, 56);
NOOK_AT(nook_bake_source_desc, weights, 64);
NOOK_AT(nook_bake_source_desc, vertex_count, 72);
NOOK_AT(nook_bake_source_desc, index_count, 76);
NOOK_AT(nook_bake_source_desc, influences, 80);
NOOK_AT(nook_bake_source_desc, bone_count, 84);
NOOK_AT(nook_bake_source_desc, bone_names, 88);
NOOK_AT(nook_bake_source_desc, bone_parents, 96);
NOOK_AT(nook_bake_source_desc, bone_frames_3x4, 104);
NOOK_AT(nook_bake_source_desc, primitives, 112);
NOOK_AT(nook_bake_source_desc, primitive_count, 120);
NOOK_AT(nook_bake_source_desc, meshes, 128);
NOOK_AT(nook_bake_source_desc, without, 136);
NOOK_AT(nook_bake_source_desc, mesh_count, 144);
NOOK_AT(nook_bake_source_desc, without_count, 148);
NOOK_AT(nook_bake_source_desc, allow_outside_files, 152);

NOOK_SIZE(nook_bake_character_info, 56);
NOOK_AT(nook_bake_character_info, struct_size, 0);
NOOK_AT(nook_bake_character_info, vertex_count, 4);
NOOK_AT(nook_bake_character_info, file_vertex_count, 8);
NOOK_AT(nook_bake_character_info, triangle_count, 12);
NOOK_AT(nook_bake_character_info, bone_count, 16);
NOOK_AT(nook_bake_character_info, clip_count, 20);
NOOK_AT(nook_bake_character_info, primitive_count, 24);
NOOK_AT(nook_bake_character_info, warning_count, 28);
NOOK_AT(nook_bake_character_info, bounds_min, 32);
NOOK_AT(nook_bake_character_info, bounds_max, 44);

NOOK_SIZE(nook_bake_character_desc, 128);
NOOK_AT(nook_bake_character_desc, struct_size, 0);
NOOK_AT(nook_bake_character_desc, type, 4);
NOOK_AT(nook_bake_character_desc, next, 8);
NOOK_AT(nook_bake_character_desc, character, 16);
NOOK_AT(nook_bake_character_desc, preset, 24);
NOOK_AT(nook_bake_character_desc, spheres, 28);
NOOK_AT(nook_bake_character_desc, key_points, 32);
NOOK_AT(nook_bake_character_desc, rays, 36);
NOOK_AT(nook_bake_character_desc, steps, 40);
NOOK_AT(nook_bake_character_desc, pose_mode, 44);
NOOK_AT(nook_bake_character_desc, auto_pose_count, 48);
NOOK_AT(nook_bake_character_desc, samples_per_clip, 52);
NOOK_AT(nook_bake_character_desc, clip_count, 56);
NOOK_AT(nook_bake_character_desc, extra_pose_count, 60);
NOOK_AT(nook_bake_character_desc, clip_names, 64);
NOOK_AT(nook_bake_character_desc, extra_poses_3x4, 72);
NOOK_AT(nook_bake_character_desc, seed, 80);
NOOK_AT(nook_bake_character_desc, threads, 88);
NOOK_AT(nook_bake_character_desc, form, 92);
NOOK_AT(nook_bake_character_desc, gamma, 96);
NOOK_AT(nook_bake_character_desc, saturation, 100);
NOOK_AT(nook_bake_character_desc, time_limit_s, 104);
NOOK_AT(nook_bake_character_desc, progress, 112);
NOOK_AT(nook_bake_character_desc, progress_user, 120);
