#include <nook/nook_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_vertex_match_desc, 104);
NOOK_AT(nook_vertex_match_desc, struct_size, 0);
NOOK_AT(nook_vertex_match_desc, type, 4);
NOOK_AT(nook_vertex_match_desc, next, 8);
NOOK_AT(nook_vertex_match_desc, positions, 16);
NOOK_AT(nook_vertex_match_desc, position_stride, 24);
NOOK_AT(nook_vertex_match_desc, normals, 32);
NOOK_AT(nook_vertex_match_desc, normal_stride, 40);
NOOK_AT(nook_vertex_match_desc, vertex_count, 48);
NOOK_AT(nook_vertex_match_desc, primitive, 52);
NOOK_AT(nook_vertex_match_desc, in_rest_space, 56);
NOOK_AT(nook_vertex_match_desc, tolerance, 60);
NOOK_AT(nook_vertex_match_desc, joints, 64);
NOOK_AT(nook_vertex_match_desc, joint_stride, 72);
NOOK_AT(nook_vertex_match_desc, weights, 80);
NOOK_AT(nook_vertex_match_desc, weight_stride, 88);
NOOK_AT(nook_vertex_match_desc, influences, 96);
NOOK_AT(nook_vertex_match_desc, skin, 100);

NOOK_SIZE(nook_vertex_match_info, 332);
NOOK_AT(nook_vertex_match_info, struct_size, 0);
NOOK_AT(nook_vertex_match_info, unmatched, 4);
NOOK_AT(nook_vertex_match_info, ambiguous, 8);
NOOK_AT(nook_vertex_match_info, text, 12);
