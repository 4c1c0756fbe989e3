/* Nook computes ambient occlusion (AO) for OpenGL engines. This header declares the version, the result
 * codes, the shared types and the context. Lengths are in metres unless you set
 * nook_context_desc.units_per_metre. Coordinate systems are right-handed. AO is in [0, 1]; 1 means not
 * occluded. The comment of each function states one of three thread contracts:
 *   any thread       Call it at any time from any thread.
 *   context thread   Call it only on the thread where the OpenGL context of the object is current.
 *   one at a time    Call it from any thread, but not during another call on the same object.
 * A failed call does not change its outputs or its objects, unless the function's comment says otherwise. */
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
/* The text after the version numbers: "-rc1" for the first release candidate, "" for a release. */
#define NOOK_VERSION_SUFFIX "-rc1"
/* The init functions pass this value, so that the library knows the version of the headers that you compiled
 * with. The value is unsigned and contains no cast, so that #if can compare it too. */
#define NOOK_VERSION (((NOOK_VERSION_MAJOR + 0u) << 22) | (NOOK_VERSION_MINOR << 12) | NOOK_VERSION_PATCH)

/* If you link the static library, define NOOK_STATIC; the CMake target and the pkg-config file do it for you.
 * Your program or plug-in then does not export Nook's functions. */
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

/* The result of a call: 0 is success, and errors are negative. nook_last_message() returns the error text. */
typedef int32_t nook_result;
enum {
  NOOK_OK = 0,
  /* A parameter is NULL, not finite or out of its range. */
  NOOK_ERROR_INVALID_ARGUMENT = -1,
  /* The scene has no instance, link or occluder with this id. */
  NOOK_ERROR_INVALID_HANDLE = -2,
  /* Your allocator returned NULL. */
  NOOK_ERROR_OUT_OF_MEMORY = -3,
  /* The bytes are not a .nook file, are truncated or corrupted, or contain the wrong kind of data. */
  NOOK_ERROR_BAD_FILE = -4,
  /* The .nook file has a format version that this library cannot read. */
  NOOK_ERROR_FILE_VERSION = -5,
  /* This library does not support the version of the headers that you compiled with. */
  NOOK_ERROR_VERSION = -6,
  /* The processor, the OpenGL context or the build of Nook does not support what the call needs. */
  NOOK_ERROR_UNSUPPORTED = -7,
  /* OpenGL reported an error, or a shader did not compile. */
  NOOK_ERROR_GL = -8,
  /* The job was cancelled, by a call or by its progress callback. */
  NOOK_ERROR_CANCELLED = -9,
  /* Nook itself has a fault; please report it with its message. */
  NOOK_ERROR_INTERNAL = -10
};

/* Returns the message of this thread's latest failure in this library: "function: what is wrong (got X, need
 * Y); what to do". The text is never NULL. It is valid until the next failure on this thread. Any thread. */
NOOK_API const char* nook_last_message(void);

/* Returns the name of a result, such as "NOOK_ERROR_BAD_FILE", or "unknown result". Any thread. */
NOOK_API const char* nook_result_name(nook_result result);

/* Returns the version of the library, encoded like NOOK_VERSION. Any thread. */
NOOK_API uint32_t nook_version(void);

/* Returns the version as text, such as "1.0.0-rc1", valid until the program ends. Any thread. */
NOOK_API const char* nook_version_text(void);

/* Your memory functions. `allocate` returns NULL if it fails; `alignment` is a power of two up to 64 bytes.
 * `release` receives the size and alignment of the allocation. Nook calls both functions on any thread that
 * calls Nook, and in the jobs of your parallel_for. */
typedef struct nook_allocator {
  void* user;
  void* (*allocate)(void* user, size_t size, size_t alignment);
  void (*release)(void* user, void* memory, size_t size, size_t alignment);
} nook_allocator;

enum { NOOK_LOG_INFO = 0, NOOK_LOG_WARNING = 1, NOOK_LOG_ERROR = 2 };
typedef int32_t nook_log_severity;
/* Receives a line of the log, on any thread that calls Nook. `text` is valid only during the call. */
typedef void (*nook_log_fn)(void* user, nook_log_severity severity, const char* text);

/* A nook_parallel_for_fn runs body(body_user, i) once for every i in [0, count), in any order and on any
 * threads, and returns after all these calls have returned. Nook does not call it from inside `body`. */
typedef void (*nook_job_fn)(void* body_user, uint32_t index);
typedef void (*nook_parallel_for_fn)(void* user, uint32_t count, nook_job_fn body, void* body_user);

/* The instruction sets of the CPU kernels. */
enum {
  /* The best set that this processor supports. */
  NOOK_ISA_AUTO = 0,
  /* Scalar code, for every platform. */
  NOOK_ISA_SCALAR = 1,
  /* For every x86-64 processor. */
  NOOK_ISA_SSE2 = 2,
  /* For x86-64 processors with AVX2 and FMA. */
  NOOK_ISA_AVX2 = 3,
  /* For x86-64 processors with AVX-512F. */
  NOOK_ISA_AVX512 = 4,
  /* For every 64-bit ARM processor. */
  NOOK_ISA_NEON = 5,
  /* For WebAssembly modules that are built with fixed-width SIMD. */
  NOOK_ISA_WASM128 = 6
};
typedef int32_t nook_isa;

/* Selects the published form of a method, or Nook's own form. */
enum {
  /* Nook's form of the method, which gives better results than the published form. */
  NOOK_FORM_DEFAULT = 0,
  /* The form of the paper, for comparisons. */
  NOOK_FORM_PAPER = 1
};
typedef int32_t nook_form;

/* Which values of each vertex a call reads. */
enum {
  /* Ambient occlusion: 1 number. */
  NOOK_CHANNEL_AO = 0,
  /* AO for the light that you set with nook_scene_set_light: 3 numbers (red, green, blue). */
  NOOK_CHANNEL_DIRECTIONAL_AO = 1,
  /* The bent normal in world space (the mean open direction), and AO: 4 numbers (x, y, z, AO). */
  NOOK_CHANNEL_BENT_NORMAL = 2
};
typedef int32_t nook_channel;

/* The format of each number of a channel. */
enum {
  /* 32-bit floats. */
  NOOK_FORMAT_FLOAT = 0,
  /* 16-bit floats, rounded to the nearest. */
  NOOK_FORMAT_HALF = 1,
  /* Unsigned bytes: 255 means 1. Values are rounded to the nearest byte; the error is at most 1/510. */
  NOOK_FORMAT_UNORM8 = 2,
  /* Signed bytes: 127 means 1, and -127 means -1. */
  NOOK_FORMAT_SNORM8 = 3
};
typedef int32_t nook_format;

/* Handles of objects. Create and load functions return a handle. Pass its address to the destroy function. */
typedef struct nook_context_s* nook_context;
typedef struct nook_model_s* nook_model;
typedef struct nook_scene_s* nook_scene;
typedef struct nook_clips_s* nook_clips;
typedef struct nook_probe_fit_s* nook_probe_fit;
typedef struct nook_probe_s* nook_probe;
typedef struct nook_material_s* nook_material;
typedef struct nook_gl_s* nook_gl;
typedef struct nook_gl_upload_s* nook_gl_upload;
typedef struct nook_nnao_s* nook_nnao;
typedef struct nook_world_s* nook_world;
typedef struct nook_bake_character_s* nook_bake_character;
typedef struct nook_bake_job_s* nook_bake_job;

/* A contiguous range of entries, such as the vertices of a primitive. */
typedef struct nook_range {
  uint32_t first, count;
} nook_range;

/* The spherical Gaussian amplitude * exp(sharpness (dot(axis, s) - 1)). */
typedef struct nook_lobe {
  /* Unit vector. */
  float axis[3];
  /* >= 0. With 0, the lobe is constant over the sphere. */
  float sharpness;
  /* Linear RGB. */
  float amplitude[3];
  float reserved;
} nook_lobe;

/* A light can have at most this many lobes, and a probe at most this many basis functions. */
#define NOOK_PROBE_MAX_FUNCTIONS 64

/* ---- Descriptors and infos ----
 *
 * A call that may get more inputs in later versions takes a descriptor, a struct whose name ends in _desc.
 * Fill it with its init function, such as nook_scene_desc_init(&desc), on any thread, then set the fields
 * that you want to change. The init function sets struct_size and type. Leave fields named `reserved` 0.
 * Leave `next` NULL, or point it to an experimental descriptor that the comment of `next` names. Programs
 * that were compiled with an older header of the same major version keep working.
 *
 * A call that describes an object fills an info, a struct whose name ends in _info. Set its struct_size
 * first; all other fields are outputs:
 *     nook_model_info info = {sizeof info}; */

/* The value of `type` in a descriptor; the init functions set it. */
enum {
  NOOK_DESC_CONTEXT = 1,
  NOOK_DESC_SCENE = 2,
  NOOK_DESC_POSE = 3,
  NOOK_DESC_GL = 4,
  NOOK_DESC_NNAO = 5,
  NOOK_DESC_NNAO_FRAME = 6,
  NOOK_DESC_WORLD = 7,
  NOOK_DESC_WORLD_FRAME = 8,
  NOOK_DESC_PROBE_FIT = 9,
  NOOK_DESC_PROBE = 10,
  NOOK_DESC_MATERIAL = 11,
  NOOK_DESC_BAKE_SOURCE = 12,
  NOOK_DESC_BAKE_CHARACTER = 13,
  NOOK_DESC_BAKE_BENT = 14,
  NOOK_DESC_BAKE_CLIPS = 15,
  NOOK_DESC_BAKE_MATERIAL = 16,
  NOOK_DESC_BAKE_SYNTHESIS = 17,
  NOOK_DESC_BAKE_TRANSFER = 18,
  NOOK_DESC_NNAO_RECORDING = 19,
  NOOK_DESC_WORLD_SAMPLE = 20,
  NOOK_DESC_GL_CAPTURE = 21,
  NOOK_DESC_TRANSFER_LIGHT = 22,
  NOOK_DESC_TRANSFER_RESPONSE = 23,
  NOOK_DESC_BAKE_TRACE = 24,
  NOOK_DESC_BAKE_IRRADIANCE = 25,
  NOOK_DESC_BONE_MAP = 26,
  NOOK_DESC_VERTEX_MATCH = 27,
  NOOK_DESC_POSE_CHECK = 28,
  NOOK_DESC_BAKE_CHARACTER_STUDY = 29,
  NOOK_DESC_TRANSFER_MESH = 30,
  NOOK_DESC_TRANSFER_VECTORS = 31,
  NOOK_DESC_PROBE_FIT_STUDY = 32,
  NOOK_DESC_GL_FRAME = 33,
  NOOK_DESC_NNAO_DEBUG = 34,
  NOOK_DESC_NNAO_FRAME_DEBUG = 35,
  NOOK_DESC_WORLD_FRAME_DEBUG = 36
};

/* Fills a descriptor of the given type with defaults. Call the typed functions instead, such as
 * nook_scene_desc_init, which pass sizeof and NOOK_VERSION. The library never writes more than `size` bytes.
 * Any thread. Errors: INVALID_ARGUMENT (desc is NULL, the type is unknown, or size is smaller than in the
 * first release), VERSION (the major version of your header differs from the library's, or its minor version
 * is newer). */
NOOK_API nook_result nook_desc_init(uint32_t type, void* desc, size_t size, uint32_t header_version);

typedef struct nook_context_desc {
  uint32_t struct_size, type;
  const void* next;
  /* If both functions are NULL (default), Nook uses the global operator new. Otherwise, you must set both. */
  nook_allocator allocator;
  /* If NULL (default), nothing is logged. */
  nook_log_fn log;
  void* log_user;
  /* If NULL (default), everything runs on the calling thread. */
  nook_parallel_for_fn parallel_for;
  void* parallel_for_user;
  /* The instruction set of all objects that you create from this context; default NOOK_ISA_AUTO. */
  nook_isa isa;
  /* Your units per metre, such as 100 for centimetres; > 0, default 1. Nook scales default lengths by it. */
  float units_per_metre;
} nook_context_desc;
static inline nook_result nook_context_desc_init(nook_context_desc* desc) {
  return nook_desc_init(NOOK_DESC_CONTEXT, desc, sizeof *desc, NOOK_VERSION);
}

/* Creates a context. You need it to create models, scenes and OpenGL objects. On failure *out is NULL.
 * Any thread. Errors: INVALID_ARGUMENT, UNSUPPORTED (the build or the processor does not support desc->isa;
 * the message lists the available sets), OUT_OF_MEMORY. */
NOOK_API nook_result nook_context_create(const nook_context_desc* desc, nook_context* out);

/* Releases your reference and sets *context to NULL; `context` and *context may be NULL. Objects keep alive
 * the parts of the context that they need, so you can destroy objects in any order. Any thread. */
NOOK_API void nook_context_destroy(nook_context* context);

#ifdef __cplusplus
}
#endif
#endif
