#include <nook/nook.h>

#include "tests/abi/layout/layout.h"

NOOK_SIZE(nook_allocator, 24);
NOOK_AT(nook_allocator, user, 0);
NOOK_AT(nook_allocator, allocate, 8);
NOOK_AT(nook_allocator, release, 16);

NOOK_SIZE(nook_context_desc, 80);
NOOK_AT(nook_context_desc, struct_size, 0);
NOOK_AT(nook_context_desc, type, 4);
NOOK_AT(nook_context_desc, next, 8);
NOOK_AT(nook_context_desc, allocator, 16);
NOOK_AT(nook_context_desc, log, 40);
NOOK_AT(nook_context_desc, log_user, 48);
NOOK_AT(nook_context_desc, parallel_for, 56);
NOOK_AT(nook_context_desc, parallel_for_user, 64);
NOOK_AT(nook_context_desc, isa, 72);
NOOK_AT(nook_context_desc, units_per_metre, 76);
