#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_material_desc, 208);
NOOK_AT(nook_bake_material_desc, struct_size, 0);
NOOK_AT(nook_bake_material_desc, type, 4);
NOOK_AT(nook_bake_material_desc, next, 8);
NOOK_AT(nook_bake_material_desc, meso, 16);
NOOK_AT(nook_bake_material_desc, btf, 24);
NOOK_AT(nook_bake_material_desc, coverage, 32);
NOOK_AT(nook_bake_material_desc, lights, 40);
NOOK_AT(nook_bake_material_desc, views, 48);
NOOK_AT(nook_bake_material_desc, light_count, 56);
NOOK_AT(nook_bake_material_desc, view_count, 60);
NOOK_AT(nook_bake_material_desc, width, 64);
NOOK_AT(nook_bake_material_desc, height, 68);
NOOK_AT(nook_bake_material_desc, max_tilt_degrees, 72);
NOOK_AT(nook_bake_material_desc, samples, 76);
NOOK_AT(nook_bake_material_desc, bounces, 80);
NOOK_AT(nook_bake_material_desc, bounce_rays, 84);
NOOK_AT(nook_bake_material_desc, method, 88);
NOOK_AT(nook_bake_material_desc, form, 92);
NOOK_AT(nook_bake_material_desc, visibility, 96);
NOOK_AT(nook_bake_material_desc, rank_light, 100);
NOOK_AT(nook_bake_material_desc, rank_view, 104);
NOOK_AT(nook_bake_material_desc, rank_x, 108);
NOOK_AT(nook_bake_material_desc, rank_y, 112);
NOOK_AT(nook_bake_material_desc, votf_rank_x, 116);
NOOK_AT(nook_bake_material_desc, votf_rank_y, 120);
NOOK_AT(nook_bake_material_desc, cluster_rank_view, 124);
NOOK_AT(nook_bake_material_desc, clusters, 128);
NOOK_AT(nook_bake_material_desc, mixture, 132);
NOOK_AT(nook_bake_material_desc, view_map_side, 136);
NOOK_AT(nook_bake_material_desc, rank_threshold, 140);
NOOK_AT(nook_bake_material_desc, visibility_threshold, 144);
NOOK_AT(nook_bake_material_desc, visibility_weight, 148);
NOOK_AT(nook_bake_material_desc, threads, 152);
NOOK_AT(nook_bake_material_desc, seed, 160);
NOOK_AT(nook_bake_material_desc, progress, 168);
NOOK_AT(nook_bake_material_desc, progress_user, 176);
NOOK_AT(nook_bake_material_desc, bits, 184);
NOOK_AT(nook_bake_material_desc, relief, 188);
NOOK_AT(nook_bake_material_desc, heights, 192);
NOOK_AT(nook_bake_material_desc, neural_channels, 200);
NOOK_AT(nook_bake_material_desc, neural_steps, 204);
