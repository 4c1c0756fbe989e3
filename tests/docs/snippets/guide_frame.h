extern nook_world world;
extern nook_nnao nnao;
