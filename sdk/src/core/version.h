// The version of nook.h as text, such as "1.0.0-rc1".
#pragma once

#include <nook/nook.h>

#define NOOK_TEXT_OF(number) #number
#define NOOK_DOTTED(major, minor, patch) NOOK_TEXT_OF(major) "." NOOK_TEXT_OF(minor) "." NOOK_TEXT_OF(patch)

namespace nook {

inline constexpr char version_text[] =
    NOOK_DOTTED(NOOK_VERSION_MAJOR, NOOK_VERSION_MINOR, NOOK_VERSION_PATCH) NOOK_VERSION_SUFFIX;

}  // namespace nook

#undef NOOK_DOTTED
#undef NOOK_TEXT_OF
