#include <nook/nook_nnao_stages.h>
extern nook_nnao pass;
extern float earlier_view_times_inverse_of_this_view[12];
extern int camera_was_cut;
extern uint32_t depth_array, i, number, layer;
extern float projections[32], earlier_views[24];
extern nook_nnao_stages stages;
extern nook_nnao_stage_info stage;
extern nook_nnao_image_info image;
extern nook_nnao_frame_desc* earlier_frame;
extern nook_nnao_frame_values values;
