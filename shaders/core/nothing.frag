// A fragment shader for programs that draw nothing, because OpenGL ES requires one in every program.
void main() {}
