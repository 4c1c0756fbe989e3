extern nook_world_pass pass;
extern nook_nnao nnao;
extern nook_nnao_frame_desc frame;
extern float open_share_of_light[4];
