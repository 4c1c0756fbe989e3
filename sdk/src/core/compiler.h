// Defines the attributes that compilers spell differently; no other header of the library has one.
#pragma once

// NOOK_PRINTF(format, first): the compiler checks the arguments from `first` on against the format string in
// parameter `format`. Parameters count from 1, in member functions from 2. MinGW's `printf` means the format
// of Microsoft's C library, without %zu and %llu, but libstdc++ replaces those functions by standard ones.
#if defined(__MINGW32__) && !defined(__clang__)
#define NOOK_PRINTF(format_parameter, first_parameter) \
  __attribute__((format(gnu_printf, format_parameter, first_parameter)))
#elif defined(__GNUC__)
#define NOOK_PRINTF(format_parameter, first_parameter) \
  __attribute__((format(printf, format_parameter, first_parameter)))
#else
#define NOOK_PRINTF(format_parameter, first_parameter)
#endif

// NOOK_INLINE: always inlines a function.
#if defined(_MSC_VER) && !defined(__clang__)
#define NOOK_INLINE __forceinline
#else
#define NOOK_INLINE inline __attribute__((always_inline))
#endif

// NOOK_TRAILING_ZEROS(word): the number of the lowest set bit of an unsigned int. It is not defined if the
// compiler has no such builtin.
#if defined(__GNUC__)
#define NOOK_TRAILING_ZEROS(word) __builtin_ctz(word)
#endif

// NOOK_CLONES: the compiler vectorises one plain source into a clone for each instruction set, and the
// program picks one when it loads. This needs the resolvers of the ELF format. Sanitizers do not work with
// these, so they run the plain version.
#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define NOOK_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define NOOK_CLONES
#endif
