#include <nook/nook_material.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_material_desc, 24);
NOOK_AT(nook_material_desc, struct_size, 0);
NOOK_AT(nook_material_desc, type, 4);
NOOK_AT(nook_material_desc, next, 8);
NOOK_AT(nook_material_desc, blocks, 16);
NOOK_AT(nook_material_desc, whole_light_modes, 20);

NOOK_SIZE(nook_material_tensor, 32);
NOOK_AT(nook_material_tensor, rank_light, 0);
NOOK_AT(nook_material_tensor, rank_view, 4);
NOOK_AT(nook_material_tensor, rank_x, 8);
NOOK_AT(nook_material_tensor, rank_y, 12);
NOOK_AT(nook_material_tensor, clusters, 16);
NOOK_AT(nook_material_tensor, mixture, 20);
NOOK_AT(nook_material_tensor, view_map_side, 24);
NOOK_AT(nook_material_tensor, terms, 28);

NOOK_SIZE(nook_material_info, 160);
NOOK_AT(nook_material_info, visibility, 4);
NOOK_AT(nook_material_info, visibility_threshold, 8);
NOOK_AT(nook_material_info, visibility_weight, 12);
NOOK_AT(nook_material_info, light_count, 16);
NOOK_AT(nook_material_info, view_count, 20);
NOOK_AT(nook_material_info, width, 24);
NOOK_AT(nook_material_info, height, 28);
NOOK_AT(nook_material_info, btf, 32);
NOOK_AT(nook_material_info, votf, 64);
NOOK_AT(nook_material_info, decode_fetches, 96);
NOOK_AT(nook_material_info, decode_multiply_adds, 100);
NOOK_AT(nook_material_info, light_fetches, 104);
NOOK_AT(nook_material_info, light_multiply_adds, 108);
NOOK_AT(nook_material_info, occlusion_fetches, 112);
NOOK_AT(nook_material_info, occlusion_multiply_adds, 116);
NOOK_AT(nook_material_info, compressed_bytes, 120);
NOOK_AT(nook_material_info, view_map_bytes, 128);
NOOK_AT(nook_material_info, table_bytes, 136);
NOOK_AT(nook_material_info, neural_channels, 144);
NOOK_AT(nook_material_info, neural_units, 148);
NOOK_AT(nook_material_info, further_decode_fetches, 152);
NOOK_AT(nook_material_info, further_occlusion_fetches, 156);

NOOK_SIZE(nook_material_pixel, 48);
NOOK_AT(nook_material_pixel, dx, 8);
NOOK_AT(nook_material_pixel, dy, 16);
NOOK_AT(nook_material_pixel, view, 24);
NOOK_AT(nook_material_pixel, light, 36);

NOOK_SIZE(nook_material_value, 20);
NOOK_AT(nook_material_value, occlusion, 12);
NOOK_AT(nook_material_value, visibility, 16);
