#include <nook/experimental/nook_transfer.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_transfer_info, 56);
NOOK_AT(nook_transfer_info, vertex_count, 4);
NOOK_AT(nook_transfer_info, lobe_count, 8);
NOOK_AT(nook_transfer_info, sharpness, 12);
NOOK_AT(nook_transfer_info, share_bytes, 16);
NOOK_AT(nook_transfer_info, bounces, 24);
NOOK_AT(nook_transfer_info, has_holes, 28);
NOOK_AT(nook_transfer_info, indirect_bytes, 32);
NOOK_AT(nook_transfer_info, form, 40);
NOOK_AT(nook_transfer_info, light_modes, 44);
NOOK_AT(nook_transfer_info, paper_bytes, 48);

NOOK_SIZE(nook_transfer_mesh_desc, 56);
NOOK_AT(nook_transfer_mesh_desc, next, 8);
NOOK_AT(nook_transfer_mesh_desc, vertex_count, 16);
NOOK_AT(nook_transfer_mesh_desc, positions, 24);
NOOK_AT(nook_transfer_mesh_desc, normals, 32);
NOOK_AT(nook_transfer_mesh_desc, tangents, 40);
NOOK_AT(nook_transfer_mesh_desc, uvs, 48);

NOOK_SIZE(nook_transfer_light_desc, 80);
NOOK_AT(nook_transfer_light_desc, next, 8);
NOOK_AT(nook_transfer_light_desc, rgb, 16);
NOOK_AT(nook_transfer_light_desc, width, 24);
NOOK_AT(nook_transfer_light_desc, height, 28);
NOOK_AT(nook_transfer_light_desc, layout, 32);
NOOK_AT(nook_transfer_light_desc, split_suns, 36);
NOOK_AT(nook_transfer_light_desc, probe, 40);
NOOK_AT(nook_transfer_light_desc, position_ws, 48);
NOOK_AT(nook_transfer_light_desc, direction, 56);
NOOK_AT(nook_transfer_light_desc, irradiance, 64);

NOOK_SIZE(nook_transfer_vectors_desc, 56);
NOOK_AT(nook_transfer_vectors_desc, next, 8);
NOOK_AT(nook_transfer_vectors_desc, transfer, 16);
NOOK_AT(nook_transfer_vectors_desc, amplitudes, 24);
NOOK_AT(nook_transfer_vectors_desc, lobe_count, 32);
NOOK_AT(nook_transfer_vectors_desc, first_vertex, 36);
NOOK_AT(nook_transfer_vectors_desc, normals, 40);
NOOK_AT(nook_transfer_vectors_desc, tangents, 48);

NOOK_SIZE(nook_transfer_sun, 28);
NOOK_AT(nook_transfer_sun, direction, 0);
NOOK_AT(nook_transfer_sun, irradiance, 12);
NOOK_AT(nook_transfer_sun, solid_angle, 24);

NOOK_SIZE(nook_transfer_projection_info, 12);
NOOK_AT(nook_transfer_projection_info, relative_error, 4);
NOOK_AT(nook_transfer_projection_info, negative_share, 8);

NOOK_SIZE(nook_transfer_response_desc, 32);
NOOK_AT(nook_transfer_response_desc, next, 8);
NOOK_AT(nook_transfer_response_desc, material, 16);
NOOK_AT(nook_transfer_response_desc, lobe_count, 24);
NOOK_AT(nook_transfer_response_desc, reserved, 28);

NOOK_SIZE(nook_transfer_response_info, 40);
NOOK_AT(nook_transfer_response_info, lobe_count, 4);
NOOK_AT(nook_transfer_response_info, light_modes, 8);
NOOK_AT(nook_transfer_response_info, vector_floats, 12);
NOOK_AT(nook_transfer_response_info, table_bytes, 16);
NOOK_AT(nook_transfer_response_info, reflectance, 24);
NOOK_AT(nook_transfer_response_info, reserved, 36);
