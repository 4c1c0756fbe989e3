extern nook_material material;
extern nook_synthesis synthesis;
extern nook_gl_upload coordinates;
