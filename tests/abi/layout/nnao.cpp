#include <nook/experimental/nook_stages.h>
#include <nook/nook_nnao.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_nnao_desc, 80);
NOOK_AT(nook_nnao_desc, struct_size, 0);
NOOK_AT(nook_nnao_desc, type, 4);
NOOK_AT(nook_nnao_desc, next, 8);
NOOK_AT(nook_nnao_desc, max_width, 16);
NOOK_AT(nook_nnao_desc, max_height, 20);
NOOK_AT(nook_nnao_desc, preset, 24);
NOOK_AT(nook_nnao_desc, taps, 28);
NOOK_AT(nook_nnao_desc, half_resolution, 32);
NOOK_AT(nook_nnao_desc, blur, 36);
NOOK_AT(nook_nnao_desc, blur_sharpness, 40);
NOOK_AT(nook_nnao_desc, bent_normals, 44);
NOOK_AT(nook_nnao_desc, network, 48);
NOOK_AT(nook_nnao_desc, network_size, 56);
NOOK_AT(nook_nnao_desc, max_history_frames, 64);
NOOK_AT(nook_nnao_desc, depth_samples, 68);
NOOK_AT(nook_nnao_desc, views, 72);
NOOK_AT(nook_nnao_desc, normal_samples, 76);

NOOK_SIZE(nook_nnao_frame_desc, 72);
NOOK_AT(nook_nnao_frame_desc, struct_size, 0);
NOOK_AT(nook_nnao_frame_desc, type, 4);
NOOK_AT(nook_nnao_frame_desc, next, 8);
NOOK_AT(nook_nnao_frame_desc, radius, 16);
NOOK_AT(nook_nnao_frame_desc, radius_kind, 20);
NOOK_AT(nook_nnao_frame_desc, scene_size, 24);
NOOK_AT(nook_nnao_frame_desc, max_radius_px, 28);
NOOK_AT(nook_nnao_frame_desc, intensity, 32);
NOOK_AT(nook_nnao_frame_desc, power, 36);
NOOK_AT(nook_nnao_frame_desc, motion_vectors, 40);
NOOK_AT(nook_nnao_frame_desc, motion_vector_scale, 44);
NOOK_AT(nook_nnao_frame_desc, reset, 52);
NOOK_AT(nook_nnao_frame_desc, min_radius_px, 56);
NOOK_AT(nook_nnao_frame_desc, fade_begin, 60);
NOOK_AT(nook_nnao_frame_desc, fade_end, 64);

NOOK_SIZE(nook_nnao_info, 48);
NOOK_AT(nook_nnao_info, texture, 4);
NOOK_AT(nook_nnao_info, texture_bytes, 8);
NOOK_AT(nook_nnao_info, taps, 16);
NOOK_AT(nook_nnao_info, half_resolution, 20);
NOOK_AT(nook_nnao_info, blur, 24);
NOOK_AT(nook_nnao_info, horizon_form, 28);
NOOK_AT(nook_nnao_info, compute, 32);
NOOK_AT(nook_nnao_info, bent_normals, 36);
NOOK_AT(nook_nnao_info, glsl, 40);

NOOK_SIZE(nook_nnao_timings, 28);
NOOK_AT(nook_nnao_timings, valid, 4);
NOOK_AT(nook_nnao_timings, normals, 8);
NOOK_AT(nook_nnao_timings, total, 24);
