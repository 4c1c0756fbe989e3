#include <nook/experimental/nook_trace.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_character_study_desc, 40);
NOOK_AT(nook_bake_character_study_desc, struct_size, 0);
NOOK_AT(nook_bake_character_study_desc, type, 4);
NOOK_AT(nook_bake_character_study_desc, next, 8);
NOOK_AT(nook_bake_character_study_desc, clip_split, 16);
NOOK_AT(nook_bake_character_study_desc, kernel, 20);
NOOK_AT(nook_bake_character_study_desc, fit, 24);
NOOK_AT(nook_bake_character_study_desc, calibration_pose_count, 28);
NOOK_AT(nook_bake_character_study_desc, calibration_poses_3x4, 32);

NOOK_SIZE(nook_bake_occluder_mesh, 24);
NOOK_AT(nook_bake_occluder_mesh, positions, 0);
NOOK_AT(nook_bake_occluder_mesh, indices, 8);
NOOK_AT(nook_bake_occluder_mesh, vertex_count, 16);
NOOK_AT(nook_bake_occluder_mesh, index_count, 20);

NOOK_SIZE(nook_bake_trace_desc, 88);
NOOK_AT(nook_bake_trace_desc, struct_size, 0);
NOOK_AT(nook_bake_trace_desc, type, 4);
NOOK_AT(nook_bake_trace_desc, next, 8);
NOOK_AT(nook_bake_trace_desc, meshes, 16);
NOOK_AT(nook_bake_trace_desc, positions, 24);
NOOK_AT(nook_bake_trace_desc, normals, 32);
NOOK_AT(nook_bake_trace_desc, mesh_count, 40);
NOOK_AT(nook_bake_trace_desc, point_count, 44);
NOOK_AT(nook_bake_trace_desc, rays, 48);
NOOK_AT(nook_bake_trace_desc, threads, 52);
NOOK_AT(nook_bake_trace_desc, seed, 56);
NOOK_AT(nook_bake_trace_desc, radius, 64);
NOOK_AT(nook_bake_trace_desc, origin_offset, 68);
NOOK_AT(nook_bake_trace_desc, progress, 72);
NOOK_AT(nook_bake_trace_desc, progress_user, 80);

NOOK_SIZE(nook_bake_environment, 16);
NOOK_AT(nook_bake_environment, rgb, 0);
NOOK_AT(nook_bake_environment, width, 8);
NOOK_AT(nook_bake_environment, height, 12);

NOOK_SIZE(nook_bake_lit_mesh, 48);
NOOK_AT(nook_bake_lit_mesh, positions, 0);
NOOK_AT(nook_bake_lit_mesh, indices, 8);
NOOK_AT(nook_bake_lit_mesh, vertex_count, 16);
NOOK_AT(nook_bake_lit_mesh, index_count, 20);
NOOK_AT(nook_bake_lit_mesh, base_colour, 24);
NOOK_AT(nook_bake_lit_mesh, emission, 36);

NOOK_SIZE(nook_bake_irradiance_desc, 104);
NOOK_AT(nook_bake_irradiance_desc, struct_size, 0);
NOOK_AT(nook_bake_irradiance_desc, type, 4);
NOOK_AT(nook_bake_irradiance_desc, next, 8);
NOOK_AT(nook_bake_irradiance_desc, meshes, 16);
NOOK_AT(nook_bake_irradiance_desc, positions, 24);
NOOK_AT(nook_bake_irradiance_desc, normals, 32);
NOOK_AT(nook_bake_irradiance_desc, environment, 40);
NOOK_AT(nook_bake_irradiance_desc, mesh_count, 56);
NOOK_AT(nook_bake_irradiance_desc, point_count, 60);
NOOK_AT(nook_bake_irradiance_desc, rays, 64);
NOOK_AT(nook_bake_irradiance_desc, threads, 68);
NOOK_AT(nook_bake_irradiance_desc, seed, 72);
NOOK_AT(nook_bake_irradiance_desc, max_bounces, 80);
NOOK_AT(nook_bake_irradiance_desc, origin_offset, 84);
NOOK_AT(nook_bake_irradiance_desc, progress, 88);
NOOK_AT(nook_bake_irradiance_desc, progress_user, 96);
