#include <nook/nook_bake.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_clips_desc, 104);
NOOK_AT(nook_bake_clips_desc, character, 16);
NOOK_AT(nook_bake_clips_desc, model, 24);
NOOK_AT(nook_bake_clips_desc, model_size, 32);
NOOK_AT(nook_bake_clips_desc, clip_names, 40);
NOOK_AT(nook_bake_clips_desc, clip_count, 48);
NOOK_AT(nook_bake_clips_desc, rays, 52);
NOOK_AT(nook_bake_clips_desc, frames_per_second, 56);
NOOK_AT(nook_bake_clips_desc, max_error, 60);
NOOK_AT(nook_bake_clips_desc, max_bytes, 64);
NOOK_AT(nook_bake_clips_desc, max_modes, 68);
NOOK_AT(nook_bake_clips_desc, seed, 72);
NOOK_AT(nook_bake_clips_desc, threads, 80);
NOOK_AT(nook_bake_clips_desc, reserved, 84);
NOOK_AT(nook_bake_clips_desc, progress, 88);
NOOK_AT(nook_bake_clips_desc, progress_user, 96);
