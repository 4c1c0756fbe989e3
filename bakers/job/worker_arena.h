// Limits the number of threads of one piece of work, independently of the rest of the process.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>

namespace nook::bake {

// 0 threads means all cores. The calling thread is one of them.
template <class Body>
void run_with_threads(std::size_t threads, Body&& body) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : int(threads));
  arena.execute(body);
}

}  // namespace nook::bake
