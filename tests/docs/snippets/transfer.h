extern nook_material material;
extern nook_transfer transfer;
extern nook_transfer_response response;
extern nook_transfer_light light;
extern nook_gl_upload uploaded;
extern float rgb[3], rotation[9], amplitudes[3], vectors[3];
extern uint32_t map_width, map_height;
