// Limits the number of threads of one piece of work, independently of the rest of the process.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <cstdint>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"

namespace nook::bake {

// Far above the number of cores of any machine. The limit prevents a hostile value from allocating all
// memory.
constexpr std::uint32_t max_threads = 1024;

// Throws if the field `threads` of a descriptor is out of range.
inline void need_threads(std::uint32_t threads) {
  check_at_most("desc.threads", threads, max_threads);
}

// 0 threads means all cores. The calling thread is one of them.
template <class Body>
void run_with_threads(std::size_t threads, Body&& body) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : int(threads));
  arena.execute(body);
}

}  // namespace nook::bake
