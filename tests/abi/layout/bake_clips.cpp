#include <nook/nook_bake_clips.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_bake_clips_desc, 96);
NOOK_AT(nook_bake_clips_desc, model, 16);
NOOK_AT(nook_bake_clips_desc, model_size, 24);
NOOK_AT(nook_bake_clips_desc, clip_names, 32);
NOOK_AT(nook_bake_clips_desc, clip_count, 40);
NOOK_AT(nook_bake_clips_desc, rays, 44);
NOOK_AT(nook_bake_clips_desc, frames_per_second, 48);
NOOK_AT(nook_bake_clips_desc, max_error, 52);
NOOK_AT(nook_bake_clips_desc, max_bytes, 56);
NOOK_AT(nook_bake_clips_desc, max_modes, 60);
NOOK_AT(nook_bake_clips_desc, seed, 64);
NOOK_AT(nook_bake_clips_desc, threads, 72);
NOOK_AT(nook_bake_clips_desc, reserved, 76);
NOOK_AT(nook_bake_clips_desc, progress, 80);
NOOK_AT(nook_bake_clips_desc, progress_user, 88);
