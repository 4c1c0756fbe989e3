extern nook_material material;
extern nook_gl_material uploaded;
