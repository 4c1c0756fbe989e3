#include <nook/nook_gl_probe.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_gl_probe_info, 24);
NOOK_AT(nook_gl_probe_info, struct_size, 0);
NOOK_AT(nook_gl_probe_info, texture, 4);
NOOK_AT(nook_gl_probe_info, bytes, 8);
NOOK_AT(nook_gl_probe_info, glsl, 16);

NOOK_SIZE(nook_gl_probe_grid_info, 96);
NOOK_AT(nook_gl_probe_grid_info, struct_size, 0);
NOOK_AT(nook_gl_probe_grid_info, texture, 4);
NOOK_AT(nook_gl_probe_grid_info, bytes, 8);
NOOK_AT(nook_gl_probe_grid_info, glsl, 16);
NOOK_AT(nook_gl_probe_grid_info, frame, 24);
NOOK_AT(nook_gl_probe_grid_info, walls, 88);
NOOK_AT(nook_gl_probe_grid_info, reserved, 92);

NOOK_SIZE(nook_gl_probe_capture_desc, 56);
NOOK_AT(nook_gl_probe_capture_desc, struct_size, 0);
NOOK_AT(nook_gl_probe_capture_desc, header_version, 4);
NOOK_AT(nook_gl_probe_capture_desc, next, 8);
NOOK_AT(nook_gl_probe_capture_desc, probe, 16);
NOOK_AT(nook_gl_probe_capture_desc, grid, 24);
NOOK_AT(nook_gl_probe_capture_desc, face_size_px, 32);
NOOK_AT(nook_gl_probe_capture_desc, level, 36);
NOOK_AT(nook_gl_probe_capture_desc, history, 40);
NOOK_AT(nook_gl_probe_capture_desc, light, 44);
NOOK_AT(nook_gl_probe_capture_desc, constraint, 48);
NOOK_AT(nook_gl_probe_capture_desc, reserved, 52);

NOOK_SIZE(nook_gl_probe_capture_result, 152);
NOOK_AT(nook_gl_probe_capture_result, struct_size, 0);
NOOK_AT(nook_gl_probe_capture_result, maps, 4);
NOOK_AT(nook_gl_probe_capture_result, harmonics, 8);
NOOK_AT(nook_gl_probe_capture_result, sun_irradiance, 116);
NOOK_AT(nook_gl_probe_capture_result, sun_direction, 128);
NOOK_AT(nook_gl_probe_capture_result, sun_solid_angle, 140);
NOOK_AT(nook_gl_probe_capture_result, used_solid_angle, 144);
NOOK_AT(nook_gl_probe_capture_result, reserved, 148);
