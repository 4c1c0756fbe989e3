// Prefetches memory that will be needed soon.
#pragma once

namespace nook {

// Any address is allowed. Does nothing on compilers without such an instruction.
inline void prefetch([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

}  // namespace nook
