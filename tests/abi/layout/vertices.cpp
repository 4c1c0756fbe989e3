#include <nook/nook_vertices.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_vertex_match, 56);
NOOK_AT(nook_vertex_match, vertex_count, 4);
NOOK_AT(nook_vertex_match, positions, 8);
NOOK_AT(nook_vertex_match, position_stride, 16);
NOOK_AT(nook_vertex_match, normals, 24);
NOOK_AT(nook_vertex_match, normal_stride, 32);
NOOK_AT(nook_vertex_match, primitive, 40);
NOOK_AT(nook_vertex_match, in_rest_space, 44);
NOOK_AT(nook_vertex_match, tolerance, 48);
NOOK_AT(nook_vertex_match, reserved, 52);
