// Whether the address sanitizer is in this build. It looks for faults of memory, so that tests of time and of
// quality may run there with less work; the plain build checks their numbers.
#pragma once

namespace nook::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

}  // namespace nook::test
