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
