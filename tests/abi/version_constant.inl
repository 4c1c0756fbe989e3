/* A host in C99 and C++17 that uses NOOK_VERSION wherever a constant may stand. It is compiled only. */
#include <nook/nook.h>

#if NOOK_VERSION < (1u << 22)
#error "NOOK_VERSION is less than 1.0.0"
#endif

enum { version_minor = (NOOK_VERSION >> 12) & 1023u };

/* Its type is the one of the parameter header_version: an array of negative size does not compile. */
typedef char version_has_32_bits[sizeof(NOOK_VERSION) == sizeof(uint32_t) ? 1 : -1];
typedef char version_is_unsigned[NOOK_VERSION - NOOK_VERSION - 1 > 0 ? 1 : -1];
typedef char
    version_has_its_parts[NOOK_VERSION >> 22 == NOOK_VERSION_MAJOR&& version_minor == NOOK_VERSION_MINOR &&
                                  (NOOK_VERSION & 4095u) == NOOK_VERSION_PATCH
                              ? 1
                              : -1];

static const uint32_t host_version = NOOK_VERSION;

nook_result make_context_desc(nook_context_desc* desc);
nook_result make_context_desc(nook_context_desc* desc) {
  return host_version == NOOK_VERSION ? nook_context_desc_init(desc) : NOOK_ERROR_VERSION;
}
