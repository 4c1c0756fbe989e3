#include <nook/nook_transfer.h>

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

NOOK_SIZE(nook_transfer_mesh, 40);
NOOK_AT(nook_transfer_mesh, vertex_count, 4);
NOOK_AT(nook_transfer_mesh, positions, 8);
NOOK_AT(nook_transfer_mesh, normals, 16);
NOOK_AT(nook_transfer_mesh, tangents, 24);
NOOK_AT(nook_transfer_mesh, uvs, 32);

NOOK_SIZE(nook_transfer_map_desc, 40);
NOOK_AT(nook_transfer_map_desc, next, 8);
NOOK_AT(nook_transfer_map_desc, rgb, 16);
NOOK_AT(nook_transfer_map_desc, width, 24);
NOOK_AT(nook_transfer_map_desc, height, 28);
NOOK_AT(nook_transfer_map_desc, layout, 32);
NOOK_AT(nook_transfer_map_desc, split_suns, 36);

NOOK_SIZE(nook_transfer_sun, 28);
NOOK_AT(nook_transfer_sun, direction, 0);
NOOK_AT(nook_transfer_sun, irradiance, 12);
NOOK_AT(nook_transfer_sun, solid_angle, 24);

NOOK_SIZE(nook_transfer_fit_quality, 12);
NOOK_AT(nook_transfer_fit_quality, relative_error, 4);
NOOK_AT(nook_transfer_fit_quality, negative_share, 8);

NOOK_SIZE(nook_transfer_response_desc, 32);
NOOK_AT(nook_transfer_response_desc, next, 8);
NOOK_AT(nook_transfer_response_desc, material, 16);
NOOK_AT(nook_transfer_response_desc, lobe_count, 24);
NOOK_AT(nook_transfer_response_desc, isa, 28);

NOOK_SIZE(nook_transfer_response_info, 40);
NOOK_AT(nook_transfer_response_info, lobe_count, 4);
NOOK_AT(nook_transfer_response_info, light_modes, 8);
NOOK_AT(nook_transfer_response_info, vector_floats, 12);
NOOK_AT(nook_transfer_response_info, table_bytes, 16);
NOOK_AT(nook_transfer_response_info, reflectance, 24);
NOOK_AT(nook_transfer_response_info, reserved, 36);
