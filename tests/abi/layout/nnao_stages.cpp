#include <nook/experimental/nook_stages.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_nnao_stages_info, 40);
NOOK_AT(nook_nnao_stages_info, stage_count, 4);
NOOK_AT(nook_nnao_stages_info, vertex_shader, 8);
NOOK_AT(nook_nnao_stages_info, network, 16);
NOOK_AT(nook_nnao_stages_info, network_bytes, 24);
NOOK_AT(nook_nnao_stages_info, taps, 28);
NOOK_AT(nook_nnao_stages_info, half_resolution, 32);
NOOK_AT(nook_nnao_stages_info, blur, 36);

NOOK_SIZE(nook_nnao_image_info, 16);
NOOK_AT(nook_nnao_image_info, format, 4);
NOOK_AT(nook_nnao_image_info, width, 8);

NOOK_SIZE(nook_nnao_stage_info, 64);
NOOK_AT(nook_nnao_stage_info, output, 4);
NOOK_AT(nook_nnao_stage_info, name, 8);
NOOK_AT(nook_nnao_stage_info, fragment_shader, 16);
NOOK_AT(nook_nnao_stage_info, draws_viewport, 24);
NOOK_AT(nook_nnao_stage_info, reads_network, 28);
NOOK_AT(nook_nnao_stage_info, input_count, 32);
NOOK_AT(nook_nnao_stage_info, inputs, 36);

NOOK_SIZE(nook_nnao_frame_values, 352);
NOOK_AT(nook_nnao_frame_values, surface_width, 4);
NOOK_AT(nook_nnao_frame_values, viewport, 12);
NOOK_AT(nook_nnao_frame_values, constants, 28);
NOOK_AT(nook_nnao_frame_values, drawn_stages, 348);
