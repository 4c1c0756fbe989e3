// The fragment shader of programs that draw nothing: OpenGL ES wants one in every program.
void main() {}
