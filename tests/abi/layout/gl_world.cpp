#include <nook/nook_world.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_world_desc, 40);
NOOK_AT(nook_world_desc, struct_size, 0);
NOOK_AT(nook_world_desc, type, 4);
NOOK_AT(nook_world_desc, next, 8);
NOOK_AT(nook_world_desc, max_width, 16);
NOOK_AT(nook_world_desc, max_height, 20);
NOOK_AT(nook_world_desc, capsules, 24);
NOOK_AT(nook_world_desc, half_resolution, 28);
NOOK_AT(nook_world_desc, coloured, 32);

NOOK_SIZE(nook_world_frame_desc, 96);
NOOK_AT(nook_world_frame_desc, struct_size, 0);
NOOK_AT(nook_world_frame_desc, type, 4);
NOOK_AT(nook_world_frame_desc, next, 8);
NOOK_AT(nook_world_frame_desc, scene, 16);
NOOK_AT(nook_world_frame_desc, capsules, 24);
NOOK_AT(nook_world_frame_desc, capsule_count, 32);
NOOK_AT(nook_world_frame_desc, cutoff_error, 36);
NOOK_AT(nook_world_frame_desc, level_error, 40);
NOOK_AT(nook_world_frame_desc, intensity, 44);
NOOK_AT(nook_world_frame_desc, power, 48);
NOOK_AT(nook_world_frame_desc, ao_texture, 52);
NOOK_AT(nook_world_frame_desc, combine, 56);
NOOK_AT(nook_world_frame_desc, lobes, 64);
NOOK_AT(nook_world_frame_desc, lobe_count, 72);
NOOK_AT(nook_world_frame_desc, light_axis, 76);
NOOK_AT(nook_world_frame_desc, light_degrees, 88);
NOOK_AT(nook_world_frame_desc, light_reach, 92);

NOOK_SIZE(nook_world_info, 40);
NOOK_AT(nook_world_info, struct_size, 0);
NOOK_AT(nook_world_info, texture, 4);
NOOK_AT(nook_world_info, caster_texture, 8);
NOOK_AT(nook_world_info, caster_target, 12);
NOOK_AT(nook_world_info, group_count, 16);
NOOK_AT(nook_world_info, caster_count, 20);
NOOK_AT(nook_world_info, texture_bytes, 24);
NOOK_AT(nook_world_info, glsl, 32);
