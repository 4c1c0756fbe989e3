extern nook_transfer transfer;
extern nook_transfer_vectors_desc vectors_desc;
extern nook_transfer_response response;
extern nook_transfer_response_desc response_desc;
extern nook_transfer_light light;
extern nook_gl_upload uploaded;
extern float rotation[9], amplitudes[3], vectors[3];
