extern nook_probe probe;
extern nook_gl_upload uploaded;
extern nook_probe_info info;
extern uint32_t index, cube_map;
