extern nook_world pass;
extern nook_nnao nnao;
extern nook_gl_frame_desc frame;
extern nook_nnao_frame_desc screen;
extern float open_share_of_light[4];
extern nook_lobe lobes[12];
extern uint32_t lobe_count;
