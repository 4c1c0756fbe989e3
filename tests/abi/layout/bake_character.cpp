#include <nook/nook_bake_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_primitive, 8);
NOOK_AT(nook_bake_primitive, first_vertex, 0);
NOOK_AT(nook_bake_primitive, vertex_count, 4);

NOOK_SIZE(nook_bake_mesh_desc, 104);
NOOK_AT(nook_bake_mesh_desc, struct_size, 0);
NOOK_AT(nook_bake_mesh_desc, header_version, 4);
NOOK_AT(nook_bake_mesh_desc, next, 8);
NOOK_AT(nook_bake_mesh_desc, positions, 16);
NOOK_AT(nook_bake_mesh_desc, indices, 24);
NOOK_AT(nook_bake_mesh_desc, joints, 32);
NOOK_AT(nook_bake_mesh_desc, weights, 40);
NOOK_AT(nook_bake_mesh_desc, vertex_count, 48);
NOOK_AT(nook_bake_mesh_desc, index_count, 52);
NOOK_AT(nook_bake_mesh_desc, influences, 56);
NOOK_AT(nook_bake_mesh_desc, bone_count, 60);
NOOK_AT(nook_bake_mesh_desc, bone_names, 64);
NOOK_AT(nook_bake_mesh_desc, bone_parents, 72);
NOOK_AT(nook_bake_mesh_desc, bone_frames_3x4, 80);
NOOK_AT(nook_bake_mesh_desc, primitives, 88);
NOOK_AT(nook_bake_mesh_desc, primitive_count, 96);

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

NOOK_SIZE(nook_bake_job_desc, 136);
NOOK_AT(nook_bake_job_desc, struct_size, 0);
NOOK_AT(nook_bake_job_desc, header_version, 4);
NOOK_AT(nook_bake_job_desc, next, 8);
NOOK_AT(nook_bake_job_desc, preset, 16);
NOOK_AT(nook_bake_job_desc, spheres, 20);
NOOK_AT(nook_bake_job_desc, key_points, 24);
NOOK_AT(nook_bake_job_desc, rays, 28);
NOOK_AT(nook_bake_job_desc, steps, 32);
NOOK_AT(nook_bake_job_desc, pose_mode, 36);
NOOK_AT(nook_bake_job_desc, auto_pose_count, 40);
NOOK_AT(nook_bake_job_desc, samples_per_clip, 44);
NOOK_AT(nook_bake_job_desc, clip_count, 48);
NOOK_AT(nook_bake_job_desc, clip_names, 56);
NOOK_AT(nook_bake_job_desc, clip_split, 64);
NOOK_AT(nook_bake_job_desc, extra_pose_count, 68);
NOOK_AT(nook_bake_job_desc, extra_poses_3x4, 72);
NOOK_AT(nook_bake_job_desc, seed, 80);
NOOK_AT(nook_bake_job_desc, threads, 88);
NOOK_AT(nook_bake_job_desc, kernel, 92);
NOOK_AT(nook_bake_job_desc, fit, 96);
NOOK_AT(nook_bake_job_desc, gamma, 100);
NOOK_AT(nook_bake_job_desc, time_limit_s, 104);
NOOK_AT(nook_bake_job_desc, progress, 112);
NOOK_AT(nook_bake_job_desc, progress_user, 120);
NOOK_AT(nook_bake_job_desc, saturation, 128);
