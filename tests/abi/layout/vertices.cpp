#include <nook/nook_character.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_vertex_match_desc, 64);
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
