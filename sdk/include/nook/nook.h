/* Nook: ambient occlusion for OpenGL engines. Base header: version handshake, results, context.
 *
 * Conventions of every header: lengths in metres, right-handed spaces, matrices as stated by each function, AO in [0, 1]
 * where 1 is open. Thread contract, one of three words on each function:
 *   any thread       may be called at any time from any thread;
 *   context thread   only on the thread where the OpenGL context it was created on is current;
 *   one at a time    any thread, but never two calls at once on the same object.
 * A failing call leaves its outputs and its objects as they were, unless it says otherwise. */
#ifndef NOOK_NOOK_H
#define NOOK_NOOK_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_VERSION_MAJOR 0
#define NOOK_VERSION_MINOR 1
#define NOOK_VERSION_PATCH 0
/* Passed to every *_desc_init, so that the library knows which header its caller was compiled with. */
#define NOOK_VERSION ((uint32_t)((NOOK_VERSION_MAJOR << 22) | (NOOK_VERSION_MINOR << 12) | NOOK_VERSION_PATCH))

#if defined(_WIN32) && !defined(NOOK_STATIC)
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

/* 0 is success; every error is negative. The text of the failure is in nook_last_message(). */
typedef int32_t nook_result;
enum {
  NOOK_OK = 0,
  NOOK_ERROR_INVALID_ARGUMENT = -1, /* a parameter is NULL, not finite or out of its range */
  NOOK_ERROR_INVALID_HANDLE = -2,   /* an instance, link or occluder id that this scene does not have */
  NOOK_ERROR_OUT_OF_MEMORY = -3,    /* the host's allocator returned NULL */
  NOOK_ERROR_BAD_FILE = -4,         /* not a .nook file, truncated, corrupted, or of another kind */
  NOOK_ERROR_FILE_VERSION = -5,     /* a .nook file of a format version that this library cannot read */
  NOOK_ERROR_VERSION = -6,          /* the caller's headers do not fit this library */
  NOOK_ERROR_UNSUPPORTED = -7,      /* the GL context or the build lacks what the call needs */
  NOOK_ERROR_GL = -8,               /* OpenGL reported an error or a shader did not compile */
  NOOK_ERROR_CANCELLED = -9,        /* a progress callback asked to stop */
  NOOK_ERROR_INTERNAL = -10         /* a fault in Nook itself; please report it with its message */
};

/* The message of this thread's latest failure of this library, "function: what is wrong (got X, need Y); what to do".
 * Never NULL; empty before the first failure; valid until this thread's next failure. Any thread. */
NOOK_API const char* nook_last_message(void);

/* A short constant name of a result, such as "NOOK_ERROR_BAD_FILE"; "unknown result" for others. Any thread. */
NOOK_API const char* nook_result_name(nook_result result);

/* The version of the library, comparable to NOOK_VERSION. Any thread. */
NOOK_API uint32_t nook_version(void);

/* Host memory. allocate returns NULL when it cannot; alignment is a power of two up to 64. release gets the same size and
 * alignment. Both may be called from any thread that calls Nook, and from the host's jobs. */
typedef struct nook_allocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* memory, size_t size, size_t alignment);
} nook_allocator;

enum { NOOK_LOG_INFO = 0, NOOK_LOG_WARNING = 1, NOOK_LOG_ERROR = 2 };
typedef int32_t nook_log_severity;
/* text is valid during the call only. May come from any thread that calls Nook. */
typedef void (*nook_log_fn)(void* user, nook_log_severity severity, const char* text);

/* Runs body(body_user, i) once for every i in [0, count), in any order and on any threads, and returns when all are
 * done. Nook never nests these calls. */
typedef void (*nook_job_fn)(void* body_user, uint32_t index);
typedef void (*nook_parallel_for_fn)(void* user, uint32_t count, nook_job_fn body, void* body_user);

/* Instruction sets of the CPU kernels. */
enum {
  NOOK_ISA_AUTO = 0, /* the best this processor has */
  NOOK_ISA_SCALAR = 1,
  NOOK_ISA_SSE2 = 2,
  NOOK_ISA_AVX2 = 3,
  NOOK_ISA_AVX512 = 4
};
typedef int32_t nook_isa;

typedef struct nook_context_s* nook_context;

typedef struct nook_context_desc {
  uint32_t struct_size;              /* set by nook_context_desc_init */
  uint32_t header_version;           /* set by nook_context_desc_init */
  const void* next;                  /* NULL */
  nook_allocator allocator;          /* all three NULL: malloc; otherwise both functions are needed */
  nook_log_fn log;                   /* NULL: silent */
  void* log_user;
  nook_parallel_for_fn parallel_for; /* NULL: everything runs on the calling thread */
  void* parallel_for_user;
} nook_context_desc;

/* Fills *desc with defaults. size is the caller's sizeof(nook_context_desc), header_version its NOOK_VERSION: the library
 * never writes past size. Any thread. Errors: INVALID_ARGUMENT (desc NULL, size smaller than the first release's),
 * VERSION (other major version, or a newer minor one). */
NOOK_API nook_result nook_context_desc_init(nook_context_desc* desc, size_t size, uint32_t header_version);

/* Creates a context, the owner of models and scenes. On failure *out is NULL. Any thread.
 * Errors: INVALID_ARGUMENT, OUT_OF_MEMORY. */
NOOK_API nook_result nook_context_create(const nook_context_desc* desc, nook_context* out);

/* Releases the caller's hold and sets *context to NULL; NULL and already-destroyed (NULL) handles are fine. Models,
 * scenes and GL objects made from it keep what they need alive, so that any order of destruction is defined.
 * Any thread. */
NOOK_API void nook_context_destroy(nook_context* context);

#ifdef __cplusplus
}
#endif
#endif
