extern const float* rest_positions;
extern const float* rest_normals;
extern const uint16_t* joints;
extern const float* weights;
extern uint32_t vertices[4];
extern nook_model mine;
void my_skinned_position(uint32_t vertex, float* position);
