// An OpenGL that draws nothing and accepts everything, so that what the library uploads can be fuzzed without
// a driver. It reads every byte that it is given and hands out mappings of exactly the requested size, so
// that the address sanitizer sees an access outside of them; it aborts where a buffer is used beyond its end.
#pragma once

namespace nook::test {

// The answers to queries: the host's textures, and which OpenGL this is.
struct SilentGl {
  int version = 45;  // 10 * major + minor
  int width = 8, height = 8;
  int depth_bits = 24;  // 0: textures have the format GL_R32F
};
SilentGl& silent_gl();

// Serves as nook_gl_desc.get_proc.
void* silent_gl_proc(void* user, const char* name);

}  // namespace nook::test
