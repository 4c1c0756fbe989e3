#include <nook/nook_nnao.h>

#include "tests/abi/layout/layout.h"

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
NOOK_AT(nook_nnao_desc, normal_samples, 84);

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

NOOK_SIZE(nook_nnao_timings, 28);
NOOK_AT(nook_nnao_timings, valid, 4);
NOOK_AT(nook_nnao_timings, normals, 8);
NOOK_AT(nook_nnao_timings, total, 24);
