#include <nook/experimental/nook_bake_materials.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_synthesis_desc, 96);
NOOK_AT(nook_bake_synthesis_desc, material, 16);
NOOK_AT(nook_bake_synthesis_desc, material_size, 24);
NOOK_AT(nook_bake_synthesis_desc, crop, 32);
NOOK_AT(nook_bake_synthesis_desc, is_tiling, 48);
NOOK_AT(nook_bake_synthesis_desc, side, 52);
NOOK_AT(nook_bake_synthesis_desc, jitter, 56);
NOOK_AT(nook_bake_synthesis_desc, passes, 60);
NOOK_AT(nook_bake_synthesis_desc, seed, 64);
NOOK_AT(nook_bake_synthesis_desc, threads, 72);
NOOK_AT(nook_bake_synthesis_desc, reserved, 76);
NOOK_AT(nook_bake_synthesis_desc, progress, 80);
NOOK_AT(nook_bake_synthesis_desc, progress_user, 88);
