#include <nook/nook_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_character_model_info, 48);
NOOK_AT(nook_character_model_info, bone_count, 4);
NOOK_AT(nook_character_model_info, sphere_count, 8);
NOOK_AT(nook_character_model_info, key_point_count, 12);
NOOK_AT(nook_character_model_info, vertex_count, 16);
NOOK_AT(nook_character_model_info, file_vertex_count, 20);
NOOK_AT(nook_character_model_info, primitive_count, 24);
NOOK_AT(nook_character_model_info, lod_count, 28);
NOOK_AT(nook_character_model_info, bounding_radius, 32);
NOOK_AT(nook_character_model_info, gamma, 36);
NOOK_AT(nook_character_model_info, skin_count, 40);
NOOK_AT(nook_character_model_info, check_vertex_count, 44);

NOOK_SIZE(nook_scene_desc, 56);
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
NOOK_AT(nook_scene_desc, far_error, 48);
NOOK_AT(nook_scene_desc, reserved, 52);

NOOK_SIZE(nook_scene_stats, 32);
NOOK_AT(nook_scene_stats, instances, 4);
NOOK_AT(nook_scene_stats, instances_updated, 8);
NOOK_AT(nook_scene_stats, links, 12);
NOOK_AT(nook_scene_stats, links_culled, 16);
NOOK_AT(nook_scene_stats, evaluations, 24);

NOOK_SIZE(nook_character_memory, 32);
NOOK_AT(nook_character_memory, struct_size, 0);
NOOK_AT(nook_character_memory, reserved, 4);
NOOK_AT(nook_character_memory, model_bytes, 8);
NOOK_AT(nook_character_memory, instance_bytes, 16);
NOOK_AT(nook_character_memory, lit_instance_bytes, 24);
