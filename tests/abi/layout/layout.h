// Checks of the sizes and offsets of public structs on 64-bit systems, at compile time: what a host was
// compiled with stays true.
#pragma once

#include <cstddef>

#define NOOK_SIZE(type, size) static_assert(sizeof(void*) != 8 || sizeof(type) == (size), #type)
#define NOOK_AT(type, field, offset) \
  static_assert(sizeof(void*) != 8 || offsetof(type, field) == (offset), #type "." #field)
