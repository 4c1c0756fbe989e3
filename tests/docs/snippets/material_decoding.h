extern nook_material material;
extern nook_gl_upload uploaded;
extern nook_gl_upload_info info;
