#include <nook/experimental/nook_bake_materials.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_transfer_desc, 144);
NOOK_AT(nook_bake_transfer_desc, positions, 16);
NOOK_AT(nook_bake_transfer_desc, normals, 24);
NOOK_AT(nook_bake_transfer_desc, tangents, 32);
NOOK_AT(nook_bake_transfer_desc, uvs, 40);
NOOK_AT(nook_bake_transfer_desc, indices, 48);
NOOK_AT(nook_bake_transfer_desc, vertex_count, 56);
NOOK_AT(nook_bake_transfer_desc, index_count, 60);
NOOK_AT(nook_bake_transfer_desc, lobes, 64);
NOOK_AT(nook_bake_transfer_desc, ray_side, 68);
NOOK_AT(nook_bake_transfer_desc, threads, 72);
NOOK_AT(nook_bake_transfer_desc, reserved, 76);
NOOK_AT(nook_bake_transfer_desc, progress, 80);
NOOK_AT(nook_bake_transfer_desc, progress_user, 88);
NOOK_AT(nook_bake_transfer_desc, bounces, 96);
NOOK_AT(nook_bake_transfer_desc, tiles, 100);
NOOK_AT(nook_bake_transfer_desc, votf, 104);
NOOK_AT(nook_bake_transfer_desc, votf_size, 112);
NOOK_AT(nook_bake_transfer_desc, material, 120);
NOOK_AT(nook_bake_transfer_desc, material_size, 128);
NOOK_AT(nook_bake_transfer_desc, clusters, 136);
NOOK_AT(nook_bake_transfer_desc, form, 140);
