extern nook_probe probe;
extern nook_gl_probe uploaded;
extern nook_probe_info info;
extern int frame_location;
extern uint32_t index, cube_map;
