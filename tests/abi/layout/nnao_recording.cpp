#include <nook/experimental/nook_recording.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_nnao_recording_desc, 288);
NOOK_AT(nook_nnao_recording_desc, struct_size, 0);
NOOK_AT(nook_nnao_recording_desc, type, 4);
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
NOOK_AT(nook_nnao_recording_desc, min_radius_px, 276);
NOOK_AT(nook_nnao_recording_desc, fade_begin, 280);
NOOK_AT(nook_nnao_recording_desc, fade_end, 284);
