// Defines macros for attributes that each compiler spells differently. No other header of the library uses
// compiler-specific attributes.
#pragma once

// NOOK_PRINTF(format, first): the parameter with the index `format` is a printf format string. The compiler
// checks that the arguments from index `first` on match it. Indices start at 1, or at 2 in member functions.
// On MinGW, the attribute `printf` stands for Microsoft's format without %zu and %llu. But on MinGW,
// libstdc++ uses the standard printf functions, so NOOK_PRINTF uses the attribute `gnu_printf` there.
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

// NOOK_TRAILING_ZEROS(word): the index of the lowest set bit of an unsigned int. Not defined if the compiler
// has no such builtin.
#if defined(__GNUC__)
#define NOOK_TRAILING_ZEROS(word) __builtin_ctz(word)
#endif
