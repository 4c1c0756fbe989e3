#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_bent_desc, 80);
NOOK_AT(nook_bake_bent_desc, character, 16);
NOOK_AT(nook_bake_bent_desc, model, 24);
NOOK_AT(nook_bake_bent_desc, model_size, 32);
NOOK_AT(nook_bake_bent_desc, rays, 40);
NOOK_AT(nook_bake_bent_desc, auto_pose_count, 44);
NOOK_AT(nook_bake_bent_desc, samples_per_clip, 48);
NOOK_AT(nook_bake_bent_desc, threads, 52);
NOOK_AT(nook_bake_bent_desc, seed, 56);
NOOK_AT(nook_bake_bent_desc, progress, 64);
NOOK_AT(nook_bake_bent_desc, progress_user, 72);
