#include <nook/experimental/nook_capture.h>
#include <nook/nook_gl.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_upload_texture, 16);
NOOK_AT(nook_gl_upload_texture, target, 0);
NOOK_AT(nook_gl_upload_texture, texture, 4);
NOOK_AT(nook_gl_upload_texture, uniform, 8);

NOOK_SIZE(nook_gl_upload_info, 360);
NOOK_AT(nook_gl_upload_info, struct_size, 0);
NOOK_AT(nook_gl_upload_info, texture_count, 4);
NOOK_AT(nook_gl_upload_info, textures, 8);
NOOK_AT(nook_gl_upload_info, bytes, 264);
NOOK_AT(nook_gl_upload_info, glsl, 272);
NOOK_AT(nook_gl_upload_info, constant, 280);
NOOK_AT(nook_gl_upload_info, constant_values, 288);
NOOK_AT(nook_gl_upload_info, constant_vec4s, 352);
NOOK_AT(nook_gl_upload_info, walls, 356);

NOOK_SIZE(nook_gl_capture_desc, 56);
NOOK_AT(nook_gl_capture_desc, struct_size, 0);
NOOK_AT(nook_gl_capture_desc, type, 4);
NOOK_AT(nook_gl_capture_desc, next, 8);
NOOK_AT(nook_gl_capture_desc, probe, 16);
NOOK_AT(nook_gl_capture_desc, grid, 24);
NOOK_AT(nook_gl_capture_desc, face_size_px, 32);
NOOK_AT(nook_gl_capture_desc, level, 36);
NOOK_AT(nook_gl_capture_desc, history, 40);
NOOK_AT(nook_gl_capture_desc, light, 44);
NOOK_AT(nook_gl_capture_desc, match_sh, 48);
NOOK_AT(nook_gl_capture_desc, reserved, 52);

NOOK_SIZE(nook_gl_capture_info, 152);
NOOK_AT(nook_gl_capture_info, struct_size, 0);
NOOK_AT(nook_gl_capture_info, maps, 4);
NOOK_AT(nook_gl_capture_info, harmonics, 8);
NOOK_AT(nook_gl_capture_info, sun_irradiance, 116);
NOOK_AT(nook_gl_capture_info, sun_direction, 128);
NOOK_AT(nook_gl_capture_info, sun_solid_angle, 140);
NOOK_AT(nook_gl_capture_info, used_solid_angle, 144);
NOOK_AT(nook_gl_capture_info, reserved, 148);
