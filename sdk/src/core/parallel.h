// Calls a function for every index, in the host's job system if the host has set one.
#pragma once

#include <nook/nook.h>

#include <cstdint>
#include <type_traits>

namespace nook {

struct Parallel {
  nook_parallel_for_fn run = nullptr;  // null: everything runs on the calling thread
  void* user = nullptr;
};

// body(index) must not throw, because the host's threads do not catch exceptions.
template <class Body>
void parallel_for(const Parallel& parallel, std::uint32_t count, Body& body) {
  static_assert(std::is_nothrow_invocable_v<Body&, std::uint32_t>);
  if (!parallel.run || count < 2) {
    for (std::uint32_t i = 0; i < count; ++i) body(i);
    return;
  }
  parallel.run(
      parallel.user, count, [](void* user, std::uint32_t index) { (*static_cast<Body*>(user))(index); },
      const_cast<void*>(static_cast<const void*>(&body)));
}

}  // namespace nook
