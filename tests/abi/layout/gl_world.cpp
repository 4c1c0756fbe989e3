#include <nook/nook_gl_world.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_world_pass_desc, 40);
NOOK_AT(nook_world_pass_desc, struct_size, 0);
NOOK_AT(nook_world_pass_desc, header_version, 4);
NOOK_AT(nook_world_pass_desc, next, 8);
NOOK_AT(nook_world_pass_desc, max_width, 16);
NOOK_AT(nook_world_pass_desc, max_height, 20);
NOOK_AT(nook_world_pass_desc, casters, 24);
NOOK_AT(nook_world_pass_desc, half_resolution, 28);
NOOK_AT(nook_world_pass_desc, coloured, 32);

NOOK_SIZE(nook_world_frame_desc, 160);
NOOK_AT(nook_world_frame_desc, struct_size, 0);
NOOK_AT(nook_world_frame_desc, header_version, 4);
NOOK_AT(nook_world_frame_desc, next, 8);
NOOK_AT(nook_world_frame_desc, screen, 16);
NOOK_AT(nook_world_frame_desc, view, 24);
NOOK_AT(nook_world_frame_desc, scene, 88);
NOOK_AT(nook_world_frame_desc, props, 96);
NOOK_AT(nook_world_frame_desc, prop_count, 104);
NOOK_AT(nook_world_frame_desc, cutoff_error, 108);
NOOK_AT(nook_world_frame_desc, level_error, 112);
NOOK_AT(nook_world_frame_desc, ao_texture, 116);
NOOK_AT(nook_world_frame_desc, composition, 120);
NOOK_AT(nook_world_frame_desc, show, 124);
NOOK_AT(nook_world_frame_desc, lobes, 128);
NOOK_AT(nook_world_frame_desc, lobe_count, 136);
NOOK_AT(nook_world_frame_desc, light_axis, 140);
NOOK_AT(nook_world_frame_desc, light_degrees, 152);
NOOK_AT(nook_world_frame_desc, light_reach, 156);

NOOK_SIZE(nook_world_pass_info, 40);
NOOK_AT(nook_world_pass_info, struct_size, 0);
NOOK_AT(nook_world_pass_info, texture, 4);
NOOK_AT(nook_world_pass_info, caster_texture, 8);
NOOK_AT(nook_world_pass_info, caster_target, 12);
NOOK_AT(nook_world_pass_info, group_count, 16);
NOOK_AT(nook_world_pass_info, caster_count, 20);
NOOK_AT(nook_world_pass_info, texture_bytes, 24);
NOOK_AT(nook_world_pass_info, glsl, 32);
