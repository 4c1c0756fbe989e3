// An OpenGL 4.5 that does nothing, to measure the CPU time of Nook's calls without a driver's.
#pragma once

#include <nook/nook_gl.h>

namespace nook::bench {

// For nook_gl_desc.get_proc. Mapped buffers share one block of memory, which grows as needed.
void* stub_loader(void* user, const char* name);

}  // namespace nook::bench
