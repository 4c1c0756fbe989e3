// Compiles a function once for each level of instruction_set.h. A call uses the clone for the level that the
// process bakes with. The attribute target_clones is similar, but it chooses the clone when the program is
// loaded, and you cannot pin its choice.
#pragma once

#include "bakers/raytrace/instruction_set.h"
#include "sdk/src/core/compiler.h"

// NOOK_CLONED(result, name, parameters, arguments) defines name(parameters), which calls clones of
// name_plain(parameters). name_plain must be NOOK_INLINE. With sanitizers, the plain version runs.
#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NOOK_CLONED(result, name, parameters, arguments)                            \
  __attribute__((target("arch=x86-64-v4"))) static result name##_on_v4 parameters { \
    return name##_plain arguments;                                                  \
  }                                                                                 \
  __attribute__((target("arch=x86-64-v3"))) static result name##_on_v3 parameters { \
    return name##_plain arguments;                                                  \
  }                                                                                 \
  result name parameters {                                                          \
    switch (::nook::bake::isa_level()) {                                            \
      case ::nook::bake::IsaLevel::v4:                                              \
        return name##_on_v4 arguments;                                              \
      case ::nook::bake::IsaLevel::v3:                                              \
        return name##_on_v3 arguments;                                              \
      default:                                                                      \
        return name##_plain arguments;                                              \
    }                                                                               \
  }
#else
#define NOOK_CLONED(result, name, parameters, arguments) \
  result name parameters {                               \
    return name##_plain arguments;                       \
  }
#endif
