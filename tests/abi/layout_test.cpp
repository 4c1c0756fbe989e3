// Sizes and offsets of the public structs on 64-bit systems: what a host was compiled with stays true.
#include <nook/nook_bake_character.h>
#include <nook/nook_bake_material.h>
#include <nook/nook_bake_trace.h>
#include <nook/nook_bake_transfer.h>
#include <nook/nook_character.h>
#include <nook/nook_gl.h>
#include <nook/nook_gl_material.h>
#include <nook/nook_gl_probe.h>
#include <nook/nook_gl_transfer.h>
#include <nook/nook_nnao.h>
#include <nook/nook_nnao_recording.h>
#include <nook/nook_nnao_stages.h>
#include <nook/nook_pose.h>
#include <nook/nook_probe.h>
#include <nook/nook_transfer.h>
#include <nook/nook_vertices.h>

#include <cstddef>

#include "tests/catch.h"

extern "C" int nook_call_everything(const void* bytes, size_t size);

#define NOOK_SIZE(type, size) static_assert(sizeof(void*) != 8 || sizeof(type) == (size), #type)
#define NOOK_AT(type, field, offset) \
  static_assert(sizeof(void*) != 8 || offsetof(type, field) == (offset), #type "." #field)

NOOK_SIZE(nook_allocator, 24);
NOOK_AT(nook_allocator, user, 0);
NOOK_AT(nook_allocator, allocate, 8);
NOOK_AT(nook_allocator, release, 16);

NOOK_SIZE(nook_context_desc, 72);
NOOK_AT(nook_context_desc, struct_size, 0);
NOOK_AT(nook_context_desc, header_version, 4);
NOOK_AT(nook_context_desc, next, 8);
NOOK_AT(nook_context_desc, allocator, 16);
NOOK_AT(nook_context_desc, log, 40);
NOOK_AT(nook_context_desc, log_user, 48);
NOOK_AT(nook_context_desc, parallel_for, 56);
NOOK_AT(nook_context_desc, parallel_for_user, 64);

NOOK_SIZE(nook_character_model_info, 40);
NOOK_AT(nook_character_model_info, bone_count, 4);
NOOK_AT(nook_character_model_info, sphere_count, 8);
NOOK_AT(nook_character_model_info, key_point_count, 12);
NOOK_AT(nook_character_model_info, vertex_count, 16);
NOOK_AT(nook_character_model_info, file_vertex_count, 20);
NOOK_AT(nook_character_model_info, primitive_count, 24);
NOOK_AT(nook_character_model_info, lod_count, 28);
NOOK_AT(nook_character_model_info, bounding_radius, 32);
NOOK_AT(nook_character_model_info, gamma, 36);

NOOK_SIZE(nook_scene_desc, 48);
NOOK_AT(nook_scene_desc, struct_size, 0);
NOOK_AT(nook_scene_desc, header_version, 4);
NOOK_AT(nook_scene_desc, next, 8);
NOOK_AT(nook_scene_desc, combine, 16);
NOOK_AT(nook_scene_desc, isa, 20);
NOOK_AT(nook_scene_desc, cutoff_error, 24);
NOOK_AT(nook_scene_desc, lod_error, 28);
NOOK_AT(nook_scene_desc, lod_distance, 32);
NOOK_AT(nook_scene_desc, lod_max_interval, 36);
NOOK_AT(nook_scene_desc, ground_radius, 40);
NOOK_AT(nook_scene_desc, strict_poses, 44);

NOOK_SIZE(nook_pose_desc, 72);
NOOK_AT(nook_pose_desc, struct_size, 0);
NOOK_AT(nook_pose_desc, header_version, 4);
NOOK_AT(nook_pose_desc, next, 8);
NOOK_AT(nook_pose_desc, kind, 16);
NOOK_AT(nook_pose_desc, layout, 20);
NOOK_AT(nook_pose_desc, transforms, 24);
NOOK_AT(nook_pose_desc, stride, 32);
NOOK_AT(nook_pose_desc, transform_count, 40);
NOOK_AT(nook_pose_desc, skin, 44);
NOOK_AT(nook_pose_desc, transform_of_bone, 48);
NOOK_AT(nook_pose_desc, bone_count, 56);
NOOK_AT(nook_pose_desc, flags, 60);
NOOK_AT(nook_pose_desc, place_3x4, 64);

NOOK_SIZE(nook_bone_names, 56);
NOOK_AT(nook_bone_names, flags, 4);
NOOK_AT(nook_bone_names, names, 8);
NOOK_AT(nook_bone_names, name_count, 16);
NOOK_AT(nook_bone_names, host_prefix, 24);
NOOK_AT(nook_bone_names, host_suffix, 32);
NOOK_AT(nook_bone_names, model_prefix, 40);
NOOK_AT(nook_bone_names, model_suffix, 48);

NOOK_SIZE(nook_skin_info, 60);
NOOK_AT(nook_skin_info, file_index, 4);
NOOK_AT(nook_skin_info, joint_count, 8);
NOOK_AT(nook_skin_info, rest_from_mesh_3x4, 12);

NOOK_SIZE(nook_rest_vertex, 36);
NOOK_AT(nook_rest_vertex, vertex, 4);
NOOK_AT(nook_rest_vertex, position, 8);
NOOK_AT(nook_rest_vertex, mesh_position, 20);
NOOK_AT(nook_rest_vertex, bone, 32);

NOOK_SIZE(nook_pose_check, 584);
NOOK_AT(nook_pose_check, vertex_count, 4);
NOOK_AT(nook_pose_check, rest_vertices, 8);
NOOK_AT(nook_pose_check, positions, 16);
NOOK_AT(nook_pose_check, stride, 24);
NOOK_AT(nook_pose_check, place_3x4, 32);
NOOK_AT(nook_pose_check, tolerance, 40);
NOOK_AT(nook_pose_check, fault, 44);
NOOK_AT(nook_pose_check, max_error, 48);
NOOK_AT(nook_pose_check, rms_error, 52);
NOOK_AT(nook_pose_check, worst_bone, 56);
NOOK_AT(nook_pose_check, fitting_skin, 60);
NOOK_AT(nook_pose_check, scale, 64);
NOOK_AT(nook_pose_check, text, 68);

NOOK_SIZE(nook_vertex_match, 56);
NOOK_AT(nook_vertex_match, vertex_count, 4);
NOOK_AT(nook_vertex_match, positions, 8);
NOOK_AT(nook_vertex_match, position_stride, 16);
NOOK_AT(nook_vertex_match, normals, 24);
NOOK_AT(nook_vertex_match, normal_stride, 32);
NOOK_AT(nook_vertex_match, primitive, 40);
NOOK_AT(nook_vertex_match, in_rest_space, 44);
NOOK_AT(nook_vertex_match, tolerance, 48);
NOOK_AT(nook_vertex_match, reserved, 52);

NOOK_SIZE(nook_scene_stats, 32);
NOOK_AT(nook_scene_stats, instances, 4);
NOOK_AT(nook_scene_stats, instances_updated, 8);
NOOK_AT(nook_scene_stats, links, 12);
NOOK_AT(nook_scene_stats, links_culled, 16);
NOOK_AT(nook_scene_stats, evaluations, 24);

NOOK_SIZE(nook_gl_desc, 40);
NOOK_AT(nook_gl_desc, struct_size, 0);
NOOK_AT(nook_gl_desc, header_version, 4);
NOOK_AT(nook_gl_desc, next, 8);
NOOK_AT(nook_gl_desc, get_proc, 16);
NOOK_AT(nook_gl_desc, get_proc_user, 24);
NOOK_AT(nook_gl_desc, max_tier, 32);
NOOK_AT(nook_gl_desc, state_mode, 36);

NOOK_SIZE(nook_gl_info, 40);
NOOK_AT(nook_gl_info, struct_size, 0);
NOOK_AT(nook_gl_info, tier, 4);
NOOK_AT(nook_gl_info, version, 8);
NOOK_AT(nook_gl_info, renderer, 16);
NOOK_AT(nook_gl_info, buffer_bytes, 24);
NOOK_AT(nook_gl_info, ao_bytes, 32);

NOOK_SIZE(nook_gl_ao_target, 40);
NOOK_AT(nook_gl_ao_target, struct_size, 0);
NOOK_AT(nook_gl_ao_target, format, 4);
NOOK_AT(nook_gl_ao_target, buffer, 8);
NOOK_AT(nook_gl_ao_target, texture, 12);
NOOK_AT(nook_gl_ao_target, offset, 16);
NOOK_AT(nook_gl_ao_target, instance_stride, 24);
NOOK_AT(nook_gl_ao_target, stride, 32);
NOOK_AT(nook_gl_ao_target, texture_width, 36);

NOOK_SIZE(nook_gl_ao_view, 24);
NOOK_AT(nook_gl_ao_view, struct_size, 0);
NOOK_AT(nook_gl_ao_view, buffer, 4);
NOOK_AT(nook_gl_ao_view, offset, 8);
NOOK_AT(nook_gl_ao_view, stride, 16);
NOOK_AT(nook_gl_ao_view, count, 20);

NOOK_SIZE(nook_gl_light_view, 40);
NOOK_AT(nook_gl_light_view, struct_size, 0);
NOOK_AT(nook_gl_light_view, buffer, 4);
NOOK_AT(nook_gl_light_view, offset, 8);
NOOK_AT(nook_gl_light_view, stride, 16);
NOOK_AT(nook_gl_light_view, count, 20);
NOOK_AT(nook_gl_light_view, texture, 24);
NOOK_AT(nook_gl_light_view, light, 28);
NOOK_AT(nook_gl_light_view, glsl, 32);

NOOK_SIZE(nook_gl_probe_info, 24);
NOOK_AT(nook_gl_probe_info, struct_size, 0);
NOOK_AT(nook_gl_probe_info, texture, 4);
NOOK_AT(nook_gl_probe_info, bytes, 8);
NOOK_AT(nook_gl_probe_info, glsl, 16);

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

NOOK_SIZE(nook_bake_progress, 24);
NOOK_AT(nook_bake_progress, struct_size, 0);
NOOK_AT(nook_bake_progress, stage, 4);
NOOK_AT(nook_bake_progress, done, 8);
NOOK_AT(nook_bake_progress, total, 16);

NOOK_SIZE(nook_bake_job_desc, 128);
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

NOOK_SIZE(nook_bake_occluder_mesh, 24);
NOOK_AT(nook_bake_occluder_mesh, positions, 0);
NOOK_AT(nook_bake_occluder_mesh, indices, 8);
NOOK_AT(nook_bake_occluder_mesh, vertex_count, 16);
NOOK_AT(nook_bake_occluder_mesh, index_count, 20);

NOOK_SIZE(nook_bake_trace_desc, 72);
NOOK_AT(nook_bake_trace_desc, struct_size, 0);
NOOK_AT(nook_bake_trace_desc, header_version, 4);
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

NOOK_SIZE(nook_bake_irradiance_desc, 88);
NOOK_AT(nook_bake_irradiance_desc, struct_size, 0);
NOOK_AT(nook_bake_irradiance_desc, header_version, 4);
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

NOOK_SIZE(nook_bake_material_desc, 176);
NOOK_AT(nook_bake_material_desc, struct_size, 0);
NOOK_AT(nook_bake_material_desc, header_version, 4);
NOOK_AT(nook_bake_material_desc, next, 8);
NOOK_AT(nook_bake_material_desc, meso, 16);
NOOK_AT(nook_bake_material_desc, btf, 24);
NOOK_AT(nook_bake_material_desc, coverage, 32);
NOOK_AT(nook_bake_material_desc, lights, 40);
NOOK_AT(nook_bake_material_desc, views, 48);
NOOK_AT(nook_bake_material_desc, light_count, 56);
NOOK_AT(nook_bake_material_desc, view_count, 60);
NOOK_AT(nook_bake_material_desc, width, 64);
NOOK_AT(nook_bake_material_desc, height, 68);
NOOK_AT(nook_bake_material_desc, max_tilt_degrees, 72);
NOOK_AT(nook_bake_material_desc, samples, 76);
NOOK_AT(nook_bake_material_desc, bounces, 80);
NOOK_AT(nook_bake_material_desc, bounce_rays, 84);
NOOK_AT(nook_bake_material_desc, method, 88);
NOOK_AT(nook_bake_material_desc, visibility, 92);
NOOK_AT(nook_bake_material_desc, rank_light, 96);
NOOK_AT(nook_bake_material_desc, rank_view, 100);
NOOK_AT(nook_bake_material_desc, rank_x, 104);
NOOK_AT(nook_bake_material_desc, rank_y, 108);
NOOK_AT(nook_bake_material_desc, votf_rank_x, 112);
NOOK_AT(nook_bake_material_desc, votf_rank_y, 116);
NOOK_AT(nook_bake_material_desc, cluster_rank_view, 120);
NOOK_AT(nook_bake_material_desc, clusters, 124);
NOOK_AT(nook_bake_material_desc, mixture, 128);
NOOK_AT(nook_bake_material_desc, view_map_side, 132);
NOOK_AT(nook_bake_material_desc, rank_threshold, 136);
NOOK_AT(nook_bake_material_desc, visibility_threshold, 140);
NOOK_AT(nook_bake_material_desc, visibility_weight, 144);
NOOK_AT(nook_bake_material_desc, threads, 148);
NOOK_AT(nook_bake_material_desc, seed, 152);
NOOK_AT(nook_bake_material_desc, progress, 160);
NOOK_AT(nook_bake_material_desc, progress_user, 168);

NOOK_SIZE(nook_material_tensor, 32);
NOOK_AT(nook_material_tensor, rank_light, 0);
NOOK_AT(nook_material_tensor, rank_view, 4);
NOOK_AT(nook_material_tensor, rank_x, 8);
NOOK_AT(nook_material_tensor, rank_y, 12);
NOOK_AT(nook_material_tensor, clusters, 16);
NOOK_AT(nook_material_tensor, mixture, 20);
NOOK_AT(nook_material_tensor, view_map_side, 24);
NOOK_AT(nook_material_tensor, terms, 28);

NOOK_SIZE(nook_material_info, 144);
NOOK_AT(nook_material_info, visibility, 4);
NOOK_AT(nook_material_info, visibility_threshold, 8);
NOOK_AT(nook_material_info, visibility_weight, 12);
NOOK_AT(nook_material_info, light_count, 16);
NOOK_AT(nook_material_info, view_count, 20);
NOOK_AT(nook_material_info, width, 24);
NOOK_AT(nook_material_info, height, 28);
NOOK_AT(nook_material_info, btf, 32);
NOOK_AT(nook_material_info, votf, 64);
NOOK_AT(nook_material_info, decode_fetches, 96);
NOOK_AT(nook_material_info, decode_multiply_adds, 100);
NOOK_AT(nook_material_info, light_fetches, 104);
NOOK_AT(nook_material_info, light_multiply_adds, 108);
NOOK_AT(nook_material_info, occlusion_fetches, 112);
NOOK_AT(nook_material_info, occlusion_multiply_adds, 116);
NOOK_AT(nook_material_info, compressed_bytes, 120);
NOOK_AT(nook_material_info, view_map_bytes, 128);
NOOK_AT(nook_material_info, table_bytes, 136);

NOOK_SIZE(nook_material_sample, 36);
NOOK_AT(nook_material_sample, level, 8);
NOOK_AT(nook_material_sample, view, 12);
NOOK_AT(nook_material_sample, light, 24);

NOOK_SIZE(nook_material_value, 20);
NOOK_AT(nook_material_value, occlusion, 12);
NOOK_AT(nook_material_value, visibility, 16);

NOOK_SIZE(nook_gl_material_desc, 24);
NOOK_AT(nook_gl_material_desc, struct_size, 0);
NOOK_AT(nook_gl_material_desc, header_version, 4);
NOOK_AT(nook_gl_material_desc, next, 8);
NOOK_AT(nook_gl_material_desc, max_layers, 16);
NOOK_AT(nook_gl_material_desc, reserved, 20);

NOOK_SIZE(nook_gl_material_info, 24);
NOOK_AT(nook_gl_material_info, texture_count, 4);
NOOK_AT(nook_gl_material_info, texture_bytes, 8);
NOOK_AT(nook_gl_material_info, glsl, 16);

NOOK_SIZE(nook_gl_material_texture, 24);
NOOK_AT(nook_gl_material_texture, target, 4);
NOOK_AT(nook_gl_material_texture, texture, 8);
NOOK_AT(nook_gl_material_texture, uniform, 16);

NOOK_SIZE(nook_nnao_desc, 88);
NOOK_AT(nook_nnao_desc, struct_size, 0);
NOOK_AT(nook_nnao_desc, header_version, 4);
NOOK_AT(nook_nnao_desc, next, 8);
NOOK_AT(nook_nnao_desc, max_width, 16);
NOOK_AT(nook_nnao_desc, max_height, 20);
NOOK_AT(nook_nnao_desc, taps, 24);
NOOK_AT(nook_nnao_desc, half_resolution, 28);
NOOK_AT(nook_nnao_desc, blur, 32);
NOOK_AT(nook_nnao_desc, blur_sharpness, 36);
NOOK_AT(nook_nnao_desc, timers, 40);
NOOK_AT(nook_nnao_desc, path, 44);
NOOK_AT(nook_nnao_desc, network, 48);
NOOK_AT(nook_nnao_desc, network_size, 56);
NOOK_AT(nook_nnao_desc, bent_normals, 64);
NOOK_AT(nook_nnao_desc, temporal_frames, 68);
NOOK_AT(nook_nnao_desc, depth_samples, 72);
NOOK_AT(nook_nnao_desc, depth_sample, 76);
NOOK_AT(nook_nnao_desc, layers, 80);

NOOK_SIZE(nook_nnao_recording_desc, 280);
NOOK_AT(nook_nnao_recording_desc, struct_size, 0);
NOOK_AT(nook_nnao_recording_desc, header_version, 4);
NOOK_AT(nook_nnao_recording_desc, next, 8);
NOOK_AT(nook_nnao_recording_desc, width, 16);
NOOK_AT(nook_nnao_recording_desc, height, 20);
NOOK_AT(nook_nnao_recording_desc, depth, 24);
NOOK_AT(nook_nnao_recording_desc, normals, 32);
NOOK_AT(nook_nnao_recording_desc, layer_texels, 40);
NOOK_AT(nook_nnao_recording_desc, ao, 48);
NOOK_AT(nook_nnao_recording_desc, depth_kind, 56);
NOOK_AT(nook_nnao_recording_desc, clip, 60);
NOOK_AT(nook_nnao_recording_desc, sky_depth, 64);
NOOK_AT(nook_nnao_recording_desc, normal_scale, 68);
NOOK_AT(nook_nnao_recording_desc, normal_bias, 72);
NOOK_AT(nook_nnao_recording_desc, normal_matrix, 76);
NOOK_AT(nook_nnao_recording_desc, projection, 112);
NOOK_AT(nook_nnao_recording_desc, radius, 176);
NOOK_AT(nook_nnao_recording_desc, max_radius_px, 180);
NOOK_AT(nook_nnao_recording_desc, intensity, 184);
NOOK_AT(nook_nnao_recording_desc, power, 188);
NOOK_AT(nook_nnao_recording_desc, layer, 192);
NOOK_AT(nook_nnao_recording_desc, view, 196);
NOOK_AT(nook_nnao_recording_desc, taps, 200);
NOOK_AT(nook_nnao_recording_desc, half_resolution, 204);
NOOK_AT(nook_nnao_recording_desc, blur, 208);
NOOK_AT(nook_nnao_recording_desc, blur_sharpness, 212);
NOOK_AT(nook_nnao_recording_desc, path, 216);
NOOK_AT(nook_nnao_recording_desc, library_version, 220);
NOOK_AT(nook_nnao_recording_desc, network, 224);
NOOK_AT(nook_nnao_recording_desc, network_size, 232);
NOOK_AT(nook_nnao_recording_desc, vendor, 240);
NOOK_AT(nook_nnao_recording_desc, renderer, 248);
NOOK_AT(nook_nnao_recording_desc, driver_version, 256);
NOOK_AT(nook_nnao_recording_desc, note, 264);
NOOK_AT(nook_nnao_recording_desc, radius_kind, 272);

NOOK_SIZE(nook_nnao_frame_desc, 320);
NOOK_AT(nook_nnao_frame_desc, width, 16);
NOOK_AT(nook_nnao_frame_desc, height, 20);
NOOK_AT(nook_nnao_frame_desc, viewport, 24);
NOOK_AT(nook_nnao_frame_desc, depth_texture, 40);
NOOK_AT(nook_nnao_frame_desc, depth_kind, 44);
NOOK_AT(nook_nnao_frame_desc, sky_depth, 48);
NOOK_AT(nook_nnao_frame_desc, normal_texture, 52);
NOOK_AT(nook_nnao_frame_desc, normal_scale, 56);
NOOK_AT(nook_nnao_frame_desc, normal_bias, 60);
NOOK_AT(nook_nnao_frame_desc, normal_matrix, 64);
NOOK_AT(nook_nnao_frame_desc, projection, 100);
NOOK_AT(nook_nnao_frame_desc, clip, 164);
NOOK_AT(nook_nnao_frame_desc, radius, 168);
NOOK_AT(nook_nnao_frame_desc, max_radius_px, 172);
NOOK_AT(nook_nnao_frame_desc, intensity, 176);
NOOK_AT(nook_nnao_frame_desc, power, 180);
NOOK_AT(nook_nnao_frame_desc, layer, 184);
NOOK_AT(nook_nnao_frame_desc, layer_texture, 188);
NOOK_AT(nook_nnao_frame_desc, target, 192);
NOOK_AT(nook_nnao_frame_desc, target_name, 196);
NOOK_AT(nook_nnao_frame_desc, blend, 200);
NOOK_AT(nook_nnao_frame_desc, view, 204);
NOOK_AT(nook_nnao_frame_desc, earlier_from_view, 208);
NOOK_AT(nook_nnao_frame_desc, motion_texture, 256);
NOOK_AT(nook_nnao_frame_desc, motion_scale, 260);
NOOK_AT(nook_nnao_frame_desc, reset, 268);
NOOK_AT(nook_nnao_frame_desc, radius_kind, 272);
NOOK_AT(nook_nnao_frame_desc, scene_size, 276);
NOOK_AT(nook_nnao_frame_desc, depth_log_scale, 280);
NOOK_AT(nook_nnao_frame_desc, depth_log_near, 284);
NOOK_AT(nook_nnao_frame_desc, depth_log_far, 288);
NOOK_AT(nook_nnao_frame_desc, layer_projections, 296);
NOOK_AT(nook_nnao_frame_desc, layer_normal_matrices, 304);
NOOK_AT(nook_nnao_frame_desc, layer_earlier_from_view, 312);

NOOK_SIZE(nook_nnao_info, 40);
NOOK_AT(nook_nnao_info, texture, 4);
NOOK_AT(nook_nnao_info, texture_bytes, 8);
NOOK_AT(nook_nnao_info, taps, 16);
NOOK_AT(nook_nnao_info, horizon_form, 20);
NOOK_AT(nook_nnao_info, path, 24);
NOOK_AT(nook_nnao_info, bent_normals, 28);
NOOK_AT(nook_nnao_info, glsl, 32);

NOOK_SIZE(nook_nnao_stages_info, 32);
NOOK_AT(nook_nnao_stages_info, stage_count, 4);
NOOK_AT(nook_nnao_stages_info, vertex_shader, 8);
NOOK_AT(nook_nnao_stages_info, network, 16);
NOOK_AT(nook_nnao_stages_info, network_bytes, 24);

NOOK_SIZE(nook_nnao_image_info, 16);
NOOK_AT(nook_nnao_image_info, format, 4);
NOOK_AT(nook_nnao_image_info, width, 8);

NOOK_SIZE(nook_nnao_stage_info, 64);
NOOK_AT(nook_nnao_stage_info, output, 4);
NOOK_AT(nook_nnao_stage_info, name, 8);
NOOK_AT(nook_nnao_stage_info, fragment_shader, 16);
NOOK_AT(nook_nnao_stage_info, draws_viewport, 24);
NOOK_AT(nook_nnao_stage_info, reads_network, 28);
NOOK_AT(nook_nnao_stage_info, input_count, 32);
NOOK_AT(nook_nnao_stage_info, inputs, 36);

NOOK_SIZE(nook_nnao_frame_values, 332);
NOOK_AT(nook_nnao_frame_values, surface_width, 4);
NOOK_AT(nook_nnao_frame_values, viewport, 12);
NOOK_AT(nook_nnao_frame_values, constants, 28);

NOOK_SIZE(nook_nnao_timings, 28);
NOOK_AT(nook_nnao_timings, valid, 4);
NOOK_AT(nook_nnao_timings, normals, 8);
NOOK_AT(nook_nnao_timings, total, 24);

NOOK_SIZE(nook_probe_lobe, 32);
NOOK_AT(nook_probe_lobe, axis, 0);
NOOK_AT(nook_probe_lobe, sharpness, 12);
NOOK_AT(nook_probe_lobe, amplitude, 16);
NOOK_AT(nook_probe_lobe, reserved, 28);

NOOK_SIZE(nook_probe_fit_desc, 104);
NOOK_AT(nook_probe_fit_desc, struct_size, 0);
NOOK_AT(nook_probe_fit_desc, header_version, 4);
NOOK_AT(nook_probe_fit_desc, next, 8);
NOOK_AT(nook_probe_fit_desc, method, 16);
NOOK_AT(nook_probe_fit_desc, constraint, 20);
NOOK_AT(nook_probe_fit_desc, basis, 24);
NOOK_AT(nook_probe_fit_desc, domain, 28);
NOOK_AT(nook_probe_fit_desc, up, 32);
NOOK_AT(nook_probe_fit_desc, lobe_count, 44);
NOOK_AT(nook_probe_fit_desc, sharpness, 48);
NOOK_AT(nook_probe_fit_desc, axes, 56);
NOOK_AT(nook_probe_fit_desc, sharpnesses, 64);
NOOK_AT(nook_probe_fit_desc, ambient, 72);
NOOK_AT(nook_probe_fit_desc, order, 76);
NOOK_AT(nook_probe_fit_desc, denominator, 80);
NOOK_AT(nook_probe_fit_desc, step, 84);
NOOK_AT(nook_probe_fit_desc, growing_samples, 88);
NOOK_AT(nook_probe_fit_desc, isa, 92);
NOOK_AT(nook_probe_fit_desc, reserved, 96);

NOOK_SIZE(nook_probe_fit_info, 80);
NOOK_AT(nook_probe_fit_info, struct_size, 0);
NOOK_AT(nook_probe_fit_info, function_count, 4);
NOOK_AT(nook_probe_fit_info, samples, 8);
NOOK_AT(nook_probe_fit_info, skipped, 16);
NOOK_AT(nook_probe_fit_info, skipped_direction, 24);
NOOK_AT(nook_probe_fit_info, skipped_radiance, 32);
NOOK_AT(nook_probe_fit_info, skipped_weight, 40);
NOOK_AT(nook_probe_fit_info, weight, 48);
NOOK_AT(nook_probe_fit_info, mean_radiance, 56);

NOOK_SIZE(nook_probe_desc, 72);
NOOK_AT(nook_probe_desc, struct_size, 0);
NOOK_AT(nook_probe_desc, header_version, 4);
NOOK_AT(nook_probe_desc, next, 8);
NOOK_AT(nook_probe_desc, functions, 16);
NOOK_AT(nook_probe_desc, counts, 24);
NOOK_AT(nook_probe_desc, origin_ws, 36);
NOOK_AT(nook_probe_desc, spacing_ws, 48);
NOOK_AT(nook_probe_desc, reserved, 60);
NOOK_AT(nook_probe_desc, coefficients, 64);

NOOK_SIZE(nook_probe_info, 76);
NOOK_AT(nook_probe_info, struct_size, 0);
NOOK_AT(nook_probe_info, basis, 4);
NOOK_AT(nook_probe_info, domain, 8);
NOOK_AT(nook_probe_info, up, 12);
NOOK_AT(nook_probe_info, function_count, 24);
NOOK_AT(nook_probe_info, ambient, 28);
NOOK_AT(nook_probe_info, order, 32);
NOOK_AT(nook_probe_info, probe_count, 36);
NOOK_AT(nook_probe_info, counts, 40);
NOOK_AT(nook_probe_info, origin_ws, 52);
NOOK_AT(nook_probe_info, spacing_ws, 64);

NOOK_SIZE(nook_probe_surface, 48);
NOOK_AT(nook_probe_surface, normal, 0);
NOOK_AT(nook_probe_surface, view, 12);
NOOK_AT(nook_probe_surface, tangent, 24);
NOOK_AT(nook_probe_surface, alpha_x, 36);
NOOK_AT(nook_probe_surface, alpha_y, 40);
NOOK_AT(nook_probe_surface, reflectance, 44);

NOOK_SIZE(nook_transfer_info, 56);
NOOK_AT(nook_transfer_info, vertex_count, 4);
NOOK_AT(nook_transfer_info, lobe_count, 8);
NOOK_AT(nook_transfer_info, sharpness, 12);
NOOK_AT(nook_transfer_info, share_bytes, 16);
NOOK_AT(nook_transfer_info, bounces, 24);
NOOK_AT(nook_transfer_info, has_holes, 28);
NOOK_AT(nook_transfer_info, indirect_bytes, 32);
NOOK_AT(nook_transfer_info, form, 40);
NOOK_AT(nook_transfer_info, light_modes, 44);
NOOK_AT(nook_transfer_info, paper_bytes, 48);

NOOK_SIZE(nook_transfer_mesh, 40);
NOOK_AT(nook_transfer_mesh, vertex_count, 4);
NOOK_AT(nook_transfer_mesh, positions, 8);
NOOK_AT(nook_transfer_mesh, normals, 16);
NOOK_AT(nook_transfer_mesh, tangents, 24);
NOOK_AT(nook_transfer_mesh, uvs, 32);

NOOK_SIZE(nook_transfer_map_desc, 40);
NOOK_AT(nook_transfer_map_desc, next, 8);
NOOK_AT(nook_transfer_map_desc, rgb, 16);
NOOK_AT(nook_transfer_map_desc, width, 24);
NOOK_AT(nook_transfer_map_desc, height, 28);
NOOK_AT(nook_transfer_map_desc, layout, 32);
NOOK_AT(nook_transfer_map_desc, split_suns, 36);

NOOK_SIZE(nook_transfer_sun, 28);
NOOK_AT(nook_transfer_sun, direction, 0);
NOOK_AT(nook_transfer_sun, irradiance, 12);
NOOK_AT(nook_transfer_sun, solid_angle, 24);

NOOK_SIZE(nook_transfer_fit_quality, 12);
NOOK_AT(nook_transfer_fit_quality, relative_error, 4);
NOOK_AT(nook_transfer_fit_quality, negative_share, 8);

NOOK_SIZE(nook_transfer_response_desc, 32);
NOOK_AT(nook_transfer_response_desc, next, 8);
NOOK_AT(nook_transfer_response_desc, material, 16);
NOOK_AT(nook_transfer_response_desc, lobe_count, 24);
NOOK_AT(nook_transfer_response_desc, isa, 28);

NOOK_SIZE(nook_transfer_response_info, 40);
NOOK_AT(nook_transfer_response_info, lobe_count, 4);
NOOK_AT(nook_transfer_response_info, light_modes, 8);
NOOK_AT(nook_transfer_response_info, vector_floats, 12);
NOOK_AT(nook_transfer_response_info, table_bytes, 16);
NOOK_AT(nook_transfer_response_info, reflectance, 24);
NOOK_AT(nook_transfer_response_info, reserved, 36);

NOOK_SIZE(nook_gl_transfer_info, 24);
NOOK_AT(nook_gl_transfer_info, texture, 4);
NOOK_AT(nook_gl_transfer_info, bytes, 8);
NOOK_AT(nook_gl_transfer_info, glsl, 16);

NOOK_SIZE(nook_bake_transfer_desc, 144);
NOOK_AT(nook_bake_transfer_desc, positions, 16);
NOOK_AT(nook_bake_transfer_desc, normals, 24);
NOOK_AT(nook_bake_transfer_desc, tangents, 32);
NOOK_AT(nook_bake_transfer_desc, uvs, 40);
NOOK_AT(nook_bake_transfer_desc, indices, 48);
NOOK_AT(nook_bake_transfer_desc, vertex_count, 56);
NOOK_AT(nook_bake_transfer_desc, index_count, 60);
NOOK_AT(nook_bake_transfer_desc, lobes, 64);
NOOK_AT(nook_bake_transfer_desc, ray_side, 68);
NOOK_AT(nook_bake_transfer_desc, threads, 72);
NOOK_AT(nook_bake_transfer_desc, reserved, 76);
NOOK_AT(nook_bake_transfer_desc, progress, 80);
NOOK_AT(nook_bake_transfer_desc, progress_user, 88);
NOOK_AT(nook_bake_transfer_desc, bounces, 96);
NOOK_AT(nook_bake_transfer_desc, tiles, 100);
NOOK_AT(nook_bake_transfer_desc, votf, 104);
NOOK_AT(nook_bake_transfer_desc, votf_size, 112);
NOOK_AT(nook_bake_transfer_desc, material, 120);
NOOK_AT(nook_bake_transfer_desc, material_size, 128);
NOOK_AT(nook_bake_transfer_desc, clusters, 136);
NOOK_AT(nook_bake_transfer_desc, reserved_2, 140);

#include "tests/abi/host.h"

std::vector<std::byte> nook_test_model_bytes() {
  return nook::test::Host().bytes;
}

TEST_CASE("a C program calls every function") {
  const nook::test::Host host;
  CHECK(nook_call_everything(host.bytes.data(), host.bytes.size()) == 0);
}
