// Function multiversioning: one clone for each instruction set, chosen when the program is loaded, from one
// plain source that the compiler vectorises. Sanitizers do not get along with the resolvers, so they run the
// plain version.
#pragma once

#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NOOK_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define NOOK_CLONES
#endif
#define NOOK_INLINE inline __attribute__((always_inline))
