#include <nook/nook_clips.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_clips_info, 40);
NOOK_AT(nook_clips_info, struct_size, 0);
NOOK_AT(nook_clips_info, clip_count, 4);
NOOK_AT(nook_clips_info, frame_count, 8);
NOOK_AT(nook_clips_info, mode_count, 12);
NOOK_AT(nook_clips_info, pose_mode_count, 16);
NOOK_AT(nook_clips_info, file_vertex_count, 20);
NOOK_AT(nook_clips_info, bone_count, 24);
NOOK_AT(nook_clips_info, reserved, 28);
NOOK_AT(nook_clips_info, memory_bytes, 32);

NOOK_SIZE(nook_clip_info, 24);
NOOK_AT(nook_clip_info, struct_size, 0);
NOOK_AT(nook_clip_info, first_frame, 4);
NOOK_AT(nook_clip_info, frame_count, 8);
NOOK_AT(nook_clip_info, duration_s, 12);
NOOK_AT(nook_clip_info, name, 16);

NOOK_SIZE(nook_clip_time, 16);
NOOK_AT(nook_clip_time, clip, 0);
NOOK_AT(nook_clip_time, wrap, 4);
NOOK_AT(nook_clip_time, seconds, 8);
