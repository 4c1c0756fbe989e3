// Limits the number of threads of one piece of work. Other work of the process is not affected.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

// Far above the number of cores of any machine. The limit keeps a bad value from using up all memory.
constexpr std::uint32_t max_threads = 1024;

// Throws if the field `threads` of a descriptor is out of range.
inline void need_threads(std::uint32_t threads) {
  check_at_most("desc.threads", threads, max_threads);
}

// Runs `body` on this many threads, one of which is the calling thread. 0 means all cores.
template <class Body>
void run_with_threads(std::size_t threads, Body&& body) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : int(threads));
  arena.execute(body);
}

}  // namespace nook::bake
