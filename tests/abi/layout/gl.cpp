#include <nook/experimental/nook_clip_crowds.h>
#include <nook/experimental/nook_debug.h>
#include <nook/experimental/nook_gl_poses.h>
#include <nook/experimental/nook_streaming.h>
#include <nook/nook_gl.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_desc, 48);
NOOK_AT(nook_gl_desc, struct_size, 0);
NOOK_AT(nook_gl_desc, type, 4);
NOOK_AT(nook_gl_desc, next, 8);
NOOK_AT(nook_gl_desc, get_proc, 16);
NOOK_AT(nook_gl_desc, get_proc_user, 24);
NOOK_AT(nook_gl_desc, max_tier, 32);
NOOK_AT(nook_gl_desc, state_mode, 36);
NOOK_AT(nook_gl_desc, debug, 40);

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

NOOK_SIZE(nook_gl_view, 40);
NOOK_AT(nook_gl_view, struct_size, 0);
NOOK_AT(nook_gl_view, buffer, 4);
NOOK_AT(nook_gl_view, offset, 8);
NOOK_AT(nook_gl_view, stride, 16);
NOOK_AT(nook_gl_view, count, 20);
NOOK_AT(nook_gl_view, texture, 24);
NOOK_AT(nook_gl_view, light, 28);
NOOK_AT(nook_gl_view, glsl, 32);

NOOK_SIZE(nook_instance_clip, 72);
NOOK_AT(nook_instance_clip, instance, 0);
NOOK_AT(nook_instance_clip, reserved, 4);
NOOK_AT(nook_instance_clip, time, 8);
NOOK_AT(nook_instance_clip, place_3x4, 24);

NOOK_SIZE(nook_gl_instance_pose, 76);
NOOK_AT(nook_gl_instance_pose, instance, 0);
NOOK_AT(nook_gl_instance_pose, first_transform, 4);
NOOK_AT(nook_gl_instance_pose, bound_centre_ws, 8);
NOOK_AT(nook_gl_instance_pose, bound_radius, 20);
NOOK_AT(nook_gl_instance_pose, scale, 24);
NOOK_AT(nook_gl_instance_pose, place_3x4, 28);

NOOK_SIZE(nook_gl_poses, 40);
NOOK_AT(nook_gl_poses, struct_size, 0);
NOOK_AT(nook_gl_poses, format, 4);
NOOK_AT(nook_gl_poses, pose, 8);
NOOK_AT(nook_gl_poses, buffer, 16);
NOOK_AT(nook_gl_poses, texture, 20);
NOOK_AT(nook_gl_poses, offset, 24);
NOOK_AT(nook_gl_poses, size, 32);

NOOK_SIZE(nook_gl_pool_desc, 16);
NOOK_AT(nook_gl_pool_desc, struct_size, 0);
NOOK_AT(nook_gl_pool_desc, places, 4);
NOOK_AT(nook_gl_pool_desc, distance, 8);
NOOK_AT(nook_gl_pool_desc, instance_count, 12);

NOOK_SIZE(nook_gl_pool_view, 24);
NOOK_AT(nook_gl_pool_view, offset, 0);
NOOK_AT(nook_gl_pool_view, buffer, 8);
NOOK_AT(nook_gl_pool_view, count, 12);
NOOK_AT(nook_gl_pool_view, generation, 16);
NOOK_AT(nook_gl_pool_view, is_near, 20);

NOOK_SIZE(nook_gl_pool_info, 12);
NOOK_AT(nook_gl_pool_info, struct_size, 0);
NOOK_AT(nook_gl_pool_info, near_count, 4);
NOOK_AT(nook_gl_pool_info, waiting_count, 8);

NOOK_SIZE(nook_gl_pool_table, 16);
NOOK_AT(nook_gl_pool_table, struct_size, 0);
NOOK_AT(nook_gl_pool_table, buffer, 4);
NOOK_AT(nook_gl_pool_table, entry_count, 8);
NOOK_AT(nook_gl_pool_table, ao_buffer_count, 12);

NOOK_SIZE(nook_gl_stream_desc, 12);
NOOK_AT(nook_gl_stream_desc, struct_size, 0);
NOOK_AT(nook_gl_stream_desc, fade_updates, 4);
NOOK_AT(nook_gl_stream_desc, instance_count, 8);

NOOK_SIZE(nook_gl_stream_info, 12);
NOOK_AT(nook_gl_stream_info, struct_size, 0);
NOOK_AT(nook_gl_stream_info, pending_count, 4);
NOOK_AT(nook_gl_stream_info, generation, 8);

NOOK_SIZE(nook_gl_memory, 32);
NOOK_AT(nook_gl_memory, struct_size, 0);
NOOK_AT(nook_gl_memory, reserved, 4);
NOOK_AT(nook_gl_memory, model_bytes, 8);
NOOK_AT(nook_gl_memory, instance_bytes, 16);
NOOK_AT(nook_gl_memory, lit_instance_bytes, 24);

NOOK_SIZE(nook_gl_frame_desc, 296);
NOOK_AT(nook_gl_frame_desc, struct_size, 0);
NOOK_AT(nook_gl_frame_desc, type, 4);
NOOK_AT(nook_gl_frame_desc, next, 8);
NOOK_AT(nook_gl_frame_desc, width, 16);
NOOK_AT(nook_gl_frame_desc, height, 20);
NOOK_AT(nook_gl_frame_desc, viewport, 24);
NOOK_AT(nook_gl_frame_desc, depth_texture, 40);
NOOK_AT(nook_gl_frame_desc, depth_kind, 44);
NOOK_AT(nook_gl_frame_desc, sky_depth, 48);
NOOK_AT(nook_gl_frame_desc, depth_log_scale, 52);
NOOK_AT(nook_gl_frame_desc, depth_log_near, 56);
NOOK_AT(nook_gl_frame_desc, depth_log_far, 60);
NOOK_AT(nook_gl_frame_desc, normal_texture, 64);
NOOK_AT(nook_gl_frame_desc, normal_scale, 68);
NOOK_AT(nook_gl_frame_desc, normal_bias, 72);
NOOK_AT(nook_gl_frame_desc, normal_matrix, 76);
NOOK_AT(nook_gl_frame_desc, projection, 112);
NOOK_AT(nook_gl_frame_desc, view, 176);
NOOK_AT(nook_gl_frame_desc, clip_space, 240);
NOOK_AT(nook_gl_frame_desc, gbuffer_ao, 244);
NOOK_AT(nook_gl_frame_desc, gbuffer_ao_texture, 248);
NOOK_AT(nook_gl_frame_desc, target, 252);
NOOK_AT(nook_gl_frame_desc, target_name, 256);
NOOK_AT(nook_gl_frame_desc, blend, 260);
NOOK_AT(nook_gl_frame_desc, textures_changed, 264);
NOOK_AT(nook_gl_frame_desc, view_projections, 272);
NOOK_AT(nook_gl_frame_desc, view_matrices, 280);
NOOK_AT(nook_gl_frame_desc, view_normal_matrices, 288);
