/* The key of a bake. Compare keys before a bake to find out whether you already have the result. `nook bake
 * ... --print-key` prints the same key for the same character and settings, and `nook inspect` shows the key
 * of a baked file. */
#ifndef NOOK_BAKE_KEY_H
#define NOOK_BAKE_KEY_H

#include "../nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The bytes of a key: 64 hexadecimal digits and a zero. */
#define NOOK_BAKE_KEY_SIZE 65

/* Writes the key of a bake without baking. `desc` is the descriptor that you would pass to nook_bake_start.
 * The key is a SHA-256 hash. It depends on all settings, the content that the bake reads, and the version
 * number of the baking code. It also depends on the versions of Nook, Embree and the compiler, and on the CPU
 * instruction set. It does not depend on threads, progress or file names. Two bakes with the same key give
 * the same file. `size` is the size of `key`, at least NOOK_BAKE_KEY_SIZE. The call takes about as long as
 * reading the data of the descriptor. On failure, `key` is not changed. Any thread. Errors: INVALID_ARGUMENT
 * and BAD_FILE as nook_bake_start, INVALID_ARGUMENT also if `size` is too small, UNSUPPORTED (NOOK_ISA in the
 * environment names an instruction set that this processor lacks), OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_key(const void* desc, char* key, size_t size);

#ifdef __cplusplus
}
#endif
#endif
