extern nook_world world;
extern nook_nnao nnao;
extern nook_nnao_frame_desc nnao_frame;
extern float open_share_of_light[4];
extern nook_lobe lobes[12];
extern uint32_t lobe_count;
