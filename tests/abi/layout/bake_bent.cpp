#include <nook/nook_bake_bent.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_bent_desc, 72);
NOOK_AT(nook_bake_bent_desc, model, 16);
NOOK_AT(nook_bake_bent_desc, model_size, 24);
NOOK_AT(nook_bake_bent_desc, rays, 32);
NOOK_AT(nook_bake_bent_desc, auto_pose_count, 36);
NOOK_AT(nook_bake_bent_desc, samples_per_clip, 40);
NOOK_AT(nook_bake_bent_desc, threads, 44);
NOOK_AT(nook_bake_bent_desc, seed, 48);
NOOK_AT(nook_bake_bent_desc, progress, 56);
NOOK_AT(nook_bake_bent_desc, progress_user, 64);
