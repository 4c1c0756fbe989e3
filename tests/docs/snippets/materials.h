extern nook_material material;
extern nook_gl_upload uploaded;
