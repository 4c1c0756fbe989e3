#include <nook/nook_pose.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_pose_desc, 72);
NOOK_AT(nook_pose_desc, struct_size, 0);
NOOK_AT(nook_pose_desc, header_version, 4);
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

NOOK_SIZE(nook_bone_names, 56);
NOOK_AT(nook_bone_names, flags, 4);
NOOK_AT(nook_bone_names, names, 8);
NOOK_AT(nook_bone_names, name_count, 16);
NOOK_AT(nook_bone_names, host_prefix, 24);
NOOK_AT(nook_bone_names, host_suffix, 32);
NOOK_AT(nook_bone_names, model_prefix, 40);
NOOK_AT(nook_bone_names, model_suffix, 48);

NOOK_SIZE(nook_skin_info, 60);
NOOK_AT(nook_skin_info, file_index, 4);
NOOK_AT(nook_skin_info, joint_count, 8);
NOOK_AT(nook_skin_info, rest_from_mesh_3x4, 12);

NOOK_SIZE(nook_rest_vertex, 36);
NOOK_AT(nook_rest_vertex, vertex, 4);
NOOK_AT(nook_rest_vertex, position, 8);
NOOK_AT(nook_rest_vertex, mesh_position, 20);
NOOK_AT(nook_rest_vertex, bone, 32);

NOOK_SIZE(nook_pose_check, 584);
NOOK_AT(nook_pose_check, vertex_count, 4);
NOOK_AT(nook_pose_check, rest_vertices, 8);
NOOK_AT(nook_pose_check, positions, 16);
NOOK_AT(nook_pose_check, stride, 24);
NOOK_AT(nook_pose_check, place_3x4, 32);
NOOK_AT(nook_pose_check, tolerance, 40);
NOOK_AT(nook_pose_check, fault, 44);
NOOK_AT(nook_pose_check, max_error, 48);
NOOK_AT(nook_pose_check, rms_error, 52);
NOOK_AT(nook_pose_check, worst_bone, 56);
NOOK_AT(nook_pose_check, fitting_skin, 60);
NOOK_AT(nook_pose_check, scale, 64);
NOOK_AT(nook_pose_check, text, 68);
