#include <nook/nook_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_pose_desc, 72);
NOOK_AT(nook_pose_desc, struct_size, 0);
NOOK_AT(nook_pose_desc, type, 4);
NOOK_AT(nook_pose_desc, next, 8);
NOOK_AT(nook_pose_desc, kind, 16);
NOOK_AT(nook_pose_desc, layout, 20);
NOOK_AT(nook_pose_desc, transforms, 24);
NOOK_AT(nook_pose_desc, stride, 32);
NOOK_AT(nook_pose_desc, transform_count, 40);
NOOK_AT(nook_pose_desc, skin, 44);
NOOK_AT(nook_pose_desc, transform_of_bone, 48);
NOOK_AT(nook_pose_desc, bone_count, 56);
NOOK_AT(nook_pose_desc, flags, 60);
NOOK_AT(nook_pose_desc, place_3x4, 64);

NOOK_SIZE(nook_bone_map_desc, 64);
NOOK_AT(nook_bone_map_desc, struct_size, 0);
NOOK_AT(nook_bone_map_desc, type, 4);
NOOK_AT(nook_bone_map_desc, next, 8);
NOOK_AT(nook_bone_map_desc, names, 16);
NOOK_AT(nook_bone_map_desc, name_count, 24);
NOOK_AT(nook_bone_map_desc, flags, 28);
NOOK_AT(nook_bone_map_desc, host_prefix, 32);
NOOK_AT(nook_bone_map_desc, host_suffix, 40);
NOOK_AT(nook_bone_map_desc, model_prefix, 48);
NOOK_AT(nook_bone_map_desc, model_suffix, 56);

NOOK_SIZE(nook_skin_info, 60);
NOOK_AT(nook_skin_info, file_index, 4);
NOOK_AT(nook_skin_info, joint_count, 8);
NOOK_AT(nook_skin_info, rest_from_mesh_3x4, 12);

NOOK_SIZE(nook_check_vertex_info, 36);
NOOK_AT(nook_check_vertex_info, vertex, 4);
NOOK_AT(nook_check_vertex_info, position, 8);
NOOK_AT(nook_check_vertex_info, mesh_position, 20);
NOOK_AT(nook_check_vertex_info, bone, 32);

NOOK_SIZE(nook_pose_check_desc, 56);
NOOK_AT(nook_pose_check_desc, struct_size, 0);
NOOK_AT(nook_pose_check_desc, type, 4);
NOOK_AT(nook_pose_check_desc, next, 8);
NOOK_AT(nook_pose_check_desc, positions, 16);
NOOK_AT(nook_pose_check_desc, stride, 24);
NOOK_AT(nook_pose_check_desc, check_vertices, 32);
NOOK_AT(nook_pose_check_desc, place_3x4, 40);
NOOK_AT(nook_pose_check_desc, vertex_count, 48);
NOOK_AT(nook_pose_check_desc, tolerance, 52);

NOOK_SIZE(nook_pose_check_info, 540);
NOOK_AT(nook_pose_check_info, fault, 4);
NOOK_AT(nook_pose_check_info, max_error, 8);
NOOK_AT(nook_pose_check_info, rms_error, 12);
NOOK_AT(nook_pose_check_info, worst_bone, 16);
NOOK_AT(nook_pose_check_info, fitting_skin, 20);
NOOK_AT(nook_pose_check_info, scale, 24);
NOOK_AT(nook_pose_check_info, text, 28);
