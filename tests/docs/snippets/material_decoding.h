extern nook_material material;
extern nook_gl_material uploaded;
extern nook_gl_material_info info;
extern nook_gl_material_texture texture;
extern uint32_t i;
