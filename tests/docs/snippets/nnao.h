#include <nook/experimental/nook_stages.h>
extern nook_nnao nnao;
extern float view[16];
extern int camera_was_cut;
extern uint32_t depth_array, i, number, eye;
extern float projections[32], views[32];
extern nook_nnao_stages stages;
extern nook_nnao_stage_info stage;
extern nook_nnao_image_info image;
extern nook_gl_frame_desc* earlier_frame;
extern nook_nnao_frame_values values;
