#include <nook/experimental/nook_debug.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_scene_instance_info, 48);
NOOK_AT(nook_scene_instance_info, struct_size, 0);
NOOK_AT(nook_scene_instance_info, level, 4);
NOOK_AT(nook_scene_instance_info, level_error, 8);
NOOK_AT(nook_scene_instance_info, sphere_count, 12);
NOOK_AT(nook_scene_instance_info, key_point_count, 16);
NOOK_AT(nook_scene_instance_info, link_count, 20);
NOOK_AT(nook_scene_instance_info, culled_count, 24);
NOOK_AT(nook_scene_instance_info, updated, 28);
NOOK_AT(nook_scene_instance_info, bound_centre_ws, 32);
NOOK_AT(nook_scene_instance_info, bound_radius, 44);

NOOK_SIZE(nook_scene_sphere, 24);
NOOK_AT(nook_scene_sphere, centre_ws, 0);
NOOK_AT(nook_scene_sphere, radius, 12);
NOOK_AT(nook_scene_sphere, bone, 16);
NOOK_AT(nook_scene_sphere, caster_weight, 20);

NOOK_SIZE(nook_scene_key_point, 48);
NOOK_AT(nook_scene_key_point, position_ws, 0);
NOOK_AT(nook_scene_key_point, shadow, 12);
NOOK_AT(nook_scene_key_point, normal_ws, 16);
NOOK_AT(nook_scene_key_point, added, 28);
NOOK_AT(nook_scene_key_point, surface_position_ws, 32);
NOOK_AT(nook_scene_key_point, index, 44);

NOOK_SIZE(nook_nnao_debug_desc, 32);
NOOK_AT(nook_nnao_debug_desc, struct_size, 0);
NOOK_AT(nook_nnao_debug_desc, type, 4);
NOOK_AT(nook_nnao_debug_desc, next, 8);
NOOK_AT(nook_nnao_debug_desc, path, 16);
NOOK_AT(nook_nnao_debug_desc, depth_sample, 20);
NOOK_AT(nook_nnao_debug_desc, timers, 24);

NOOK_SIZE(nook_nnao_frame_debug_desc, 24);
NOOK_AT(nook_nnao_frame_debug_desc, struct_size, 0);
NOOK_AT(nook_nnao_frame_debug_desc, type, 4);
NOOK_AT(nook_nnao_frame_debug_desc, next, 8);
NOOK_AT(nook_nnao_frame_debug_desc, show, 16);

NOOK_SIZE(nook_world_frame_debug_desc, 24);
NOOK_AT(nook_world_frame_debug_desc, struct_size, 0);
NOOK_AT(nook_world_frame_debug_desc, type, 4);
NOOK_AT(nook_world_frame_debug_desc, next, 8);
NOOK_AT(nook_world_frame_debug_desc, show, 16);
