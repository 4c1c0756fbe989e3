/* The key of a bake: ask before you bake whether you have the result already. `nook bake ... --print-key`
 * prints the same key for the same character and settings, and `nook inspect` shows the key of a baked file.
 */
#ifndef NOOK_BAKE_KEY_H
#define NOOK_BAKE_KEY_H

#include "../nook_bake.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The bytes of a key: 64 hexadecimal digits and a zero. */
#define NOOK_BAKE_KEY_SIZE 65

/* Writes the key of the bake that nook_bake_start would start with this descriptor, without baking. The key
 * is a SHA-256. It counts all settings, the content that the bake reads, and the generation of the baking
 * code. It also counts the versions of Nook, Embree and the compiler, and the instruction set. Threads,
 * progress and names of files do not count. Two bakes with one key give the same file. size is the size of
 * key and at least NOOK_BAKE_KEY_SIZE. A call takes as long as reading the data of the descriptor. On failure
 * key stays as it is. Any thread. Errors: INVALID_ARGUMENT and BAD_FILE as nook_bake_start, also where size
 * is too small, UNSUPPORTED (NOOK_ISA in the environment names an instruction set that this processor lacks),
 * OUT_OF_MEMORY. */
NOOK_API nook_result nook_bake_key(const void* desc, char* key, size_t size);

#ifdef __cplusplus
}
#endif
#endif
