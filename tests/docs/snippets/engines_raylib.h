// What the page about raylib uses of raylib.h, rlgl.h and raymath.h of raylib 5.5.
struct Vector3 {
  float x, y, z;
};
struct Quaternion {
  float x, y, z, w;
};
struct Transform {
  Vector3 translation;
  Quaternion rotation;
  Vector3 scale;
};
struct Matrix {
  float m0, m4, m8, m12, m1, m5, m9, m13, m2, m6, m10, m14, m3, m7, m11, m15;
};
struct Mesh {
  unsigned vaoId;
};
struct Model {
  Matrix transform;
};
struct ModelAnimation {
  int boneCount;
  Transform** framePoses;
};
struct float16 {
  float v[16];
};
enum { RL_FLOAT = 0x1406 };
extern "C" void* rlGetProcAddress(const char* name);
Matrix rlGetMatrixProjection();
float16 MatrixToFloatV(Matrix matrix);
#define MatrixToFloat(matrix) (MatrixToFloatV(matrix).v)
bool rlEnableVertexArray(unsigned id);
void rlDisableVertexArray();
void rlEnableVertexBuffer(unsigned id);
void rlSetVertexAttribute(unsigned index, int size, int type, bool normalized, int stride, int offset);
void rlEnableVertexAttribute(unsigned index);

extern Model model_in_raylib;
extern Mesh mesh;
extern ModelAnimation animation;
extern int frame;
extern const int32_t* bone_map;
extern uint32_t bone_count;
extern nook_range primitive;
extern nook_gl_frame_desc frame_desc;
