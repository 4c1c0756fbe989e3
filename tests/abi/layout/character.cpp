#include <nook/nook_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_model_info, 72);
NOOK_AT(nook_model_info, bone_count, 4);
NOOK_AT(nook_model_info, sphere_count, 8);
NOOK_AT(nook_model_info, key_point_count, 12);
NOOK_AT(nook_model_info, vertex_count, 16);
NOOK_AT(nook_model_info, file_vertex_count, 20);
NOOK_AT(nook_model_info, primitive_count, 24);
NOOK_AT(nook_model_info, lod_count, 28);
NOOK_AT(nook_model_info, bounding_radius, 32);
NOOK_AT(nook_model_info, gamma, 36);
NOOK_AT(nook_model_info, skin_count, 40);
NOOK_AT(nook_model_info, check_vertex_count, 44);
NOOK_AT(nook_model_info, model_bytes, 48);
NOOK_AT(nook_model_info, instance_bytes, 56);
NOOK_AT(nook_model_info, lit_instance_bytes, 64);

NOOK_SIZE(nook_scene_desc, 48);
NOOK_AT(nook_scene_desc, struct_size, 0);
NOOK_AT(nook_scene_desc, type, 4);
NOOK_AT(nook_scene_desc, next, 8);
NOOK_AT(nook_scene_desc, form, 16);
NOOK_AT(nook_scene_desc, cutoff_error, 20);
NOOK_AT(nook_scene_desc, lod_error, 24);
NOOK_AT(nook_scene_desc, lod_distance, 28);
NOOK_AT(nook_scene_desc, lod_max_interval, 32);
NOOK_AT(nook_scene_desc, ground_radius, 36);
NOOK_AT(nook_scene_desc, strict_poses, 40);
NOOK_AT(nook_scene_desc, far_error, 44);

NOOK_SIZE(nook_scene_info, 40);
NOOK_AT(nook_scene_info, instances, 4);
NOOK_AT(nook_scene_info, instances_updated, 8);
NOOK_AT(nook_scene_info, links, 12);
NOOK_AT(nook_scene_info, links_culled, 16);
NOOK_AT(nook_scene_info, uneven_instances, 20);
NOOK_AT(nook_scene_info, evaluations, 24);
NOOK_AT(nook_scene_info, memory_bytes, 32);

NOOK_SIZE(nook_occluder, 20);
NOOK_AT(nook_occluder, centre_ws, 0);
NOOK_AT(nook_occluder, radius, 12);
NOOK_AT(nook_occluder, receiver, 16);
