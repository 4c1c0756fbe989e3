/* Nook computes ambient occlusion (AO) for OpenGL engines. This base header holds the version handshake, the
 * results and the context.
 *
 * All headers share these conventions. Lengths are in metres and spaces are right-handed. Each function
 * states the layout of its matrices. AO lies in [0, 1], where 1 is open. Each function states one of three
 * thread contracts:
 *   any thread       The function may be called at any time from any thread.
 *   context thread   The function may be called only on the thread where the OpenGL context of the object is
 *                    current.
 *   one at a time    The function may be called from any thread, but never twice at once on the same object.
 *
 * A call that fails leaves its outputs and its objects as they were, unless its comment says otherwise. */
#ifndef NOOK_NOOK_H
#define NOOK_NOOK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_VERSION_MAJOR 1
#define NOOK_VERSION_MINOR 0
#define NOOK_VERSION_PATCH 0
/* The text behind the numbers: "-rc1" for the first candidate of a release, "" for the release. */
#define NOOK_VERSION_SUFFIX "-rc1"
/* The caller passes this value to every *_desc_init, so that the library knows with which header the caller
 * was compiled. Unsigned, and without a cast, so that #if can compare it too. */
#define NOOK_VERSION (((NOOK_VERSION_MAJOR + 0u) << 22) | (NOOK_VERSION_MINOR << 12) | NOOK_VERSION_PATCH)

/* Hosts of the static library define NOOK_STATIC; the CMake target and the pkg-config file do it for them.
 * The functions then stay inside the program or plug-in that links the library. */
#if defined(NOOK_STATIC)
#define NOOK_API
#elif defined(_WIN32)
#ifdef NOOK_BUILDING
#define NOOK_API __declspec(dllexport)
#else
#define NOOK_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define NOOK_API __attribute__((visibility("default")))
#else
#define NOOK_API
#endif

/* The result of a call: 0 is success and every error is negative. nook_last_message() returns the text of the
 * failure. */
typedef int32_t nook_result;
enum {
  NOOK_OK = 0,
  /* A parameter is NULL, not finite or out of its range. */
  NOOK_ERROR_INVALID_ARGUMENT = -1,
  /* The scene has no instance, link or occluder with this id. */
  NOOK_ERROR_INVALID_HANDLE = -2,
  /* The host's allocator returned NULL. */
  NOOK_ERROR_OUT_OF_MEMORY = -3,
  /* The bytes are not a .nook file, are truncated or corrupted, or hold another kind of data. */
  NOOK_ERROR_BAD_FILE = -4,
  /* The .nook file has a format version that this library cannot read. */
  NOOK_ERROR_FILE_VERSION = -5,
  /* The caller's headers do not fit this library. */
  NOOK_ERROR_VERSION = -6,
  /* The processor, the GL context or the build lacks what the call needs. */
  NOOK_ERROR_UNSUPPORTED = -7,
  /* OpenGL reported an error, or a shader did not compile. */
  NOOK_ERROR_GL = -8,
  /* The job was cancelled, by a call or by its progress callback. */
  NOOK_ERROR_CANCELLED = -9,
  /* Nook itself has a fault; please report it with its message. */
  NOOK_ERROR_INTERNAL = -10
};

/* Returns the message of this thread's latest failure in this library, in the form "function: what is wrong
 * (got X, need Y); what to do". The text is never NULL, is empty before the first failure, and stays valid
 * until this thread's next failure.
 * Any thread. */
NOOK_API const char* nook_last_message(void);

/* Returns the constant name of a result, such as "NOOK_ERROR_BAD_FILE", or "unknown result" for any other
 * number.
 * Any thread. */
NOOK_API const char* nook_result_name(nook_result result);

/* Returns the version of the library, which compares with NOOK_VERSION.
 * Any thread. */
NOOK_API uint32_t nook_version(void);

/* Returns the version of the library as text, such as "1.0.0-rc1": its numbers and NOOK_VERSION_SUFFIX. The
 * text is valid until the program ends.
 * Any thread. */
NOOK_API const char* nook_version_text(void);

/* The host's memory functions. allocate returns size bytes, or NULL when it cannot; alignment is a power of
 * two up to 64 bytes. release receives the same size and alignment. Nook calls both from any thread that
 * calls Nook, and from the host's jobs. */
typedef struct nook_allocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* memory, size_t size, size_t alignment);
} nook_allocator;

enum { NOOK_LOG_INFO = 0, NOOK_LOG_WARNING = 1, NOOK_LOG_ERROR = 2 };
typedef int32_t nook_log_severity;
/* Receives one line of the log; text is valid during the call only. Nook calls it from any thread that calls
 * Nook. */
typedef void (*nook_log_fn)(void* user, nook_log_severity severity, const char* text);

/* A nook_parallel_for_fn runs body(body_user, i) once for every i in [0, count), in any order and on any
 * threads, and returns when all of them are done. Nook never nests these calls. */
typedef void (*nook_job_fn)(void* body_user, uint32_t index);
typedef void (*nook_parallel_for_fn)(void* user, uint32_t count, nook_job_fn body, void* body_user);

/* The instruction sets of the CPU kernels. A set that the build or the processor lacks fails with
 * UNSUPPORTED. */
enum {
  /* The best instruction set of this processor. */
  NOOK_ISA_AUTO = 0,
  /* On every platform: one number at a time. */
  NOOK_ISA_SCALAR = 1,
  /* x86-64: every processor. */
  NOOK_ISA_SSE2 = 2,
  /* x86-64: processors with AVX2 and FMA. */
  NOOK_ISA_AVX2 = 3,
  /* x86-64: processors with AVX-512F. */
  NOOK_ISA_AVX512 = 4,
  /* 64-bit ARM: every processor. */
  NOOK_ISA_NEON = 5,
  /* WebAssembly: modules that are built with its fixed-width SIMD. */
  NOOK_ISA_WASM128 = 6
};
typedef int32_t nook_isa;

typedef struct nook_context_s* nook_context;

typedef struct nook_context_desc {
  /* nook_context_desc_init sets these two. */
  uint32_t struct_size;
  uint32_t header_version;
  /* Must be NULL. */
  const void* next;
  /* Both functions NULL: Nook uses the global operator new (default). Otherwise both are required. */
  nook_allocator allocator;
  /* NULL: nothing is logged (default). */
  nook_log_fn log;
  void* log_user;
  /* NULL: everything runs on the calling thread (default). */
  nook_parallel_for_fn parallel_for;
  void* parallel_for_user;
} nook_context_desc;

/* Fills *desc with defaults. size is the caller's sizeof(nook_context_desc) and header_version its
 * NOOK_VERSION; the library never writes beyond size bytes.
 * Any thread. Errors: INVALID_ARGUMENT (desc is NULL, or size is smaller than in the first release), VERSION
 * (the major version differs, or the minor version is newer than the library's). */
NOOK_API nook_result nook_context_desc_init(nook_context_desc* desc, size_t size, uint32_t header_version);

/* Creates a context, which models, scenes and GL objects are created from. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, VERSION, OUT_OF_MEMORY. */
NOOK_API nook_result nook_context_create(const nook_context_desc* desc, nook_context* out);

/* Releases the caller's reference and sets *context to NULL; context and *context may be NULL. Models, scenes
 * and GL objects that were created from it keep alive what they need, so that objects may be destroyed in any
 * order.
 * Any thread. */
NOOK_API void nook_context_destroy(nook_context* context);

#ifdef __cplusplus
}
#endif
#endif
