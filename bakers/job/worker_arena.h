// Limits how many threads one piece of work may use, whatever else the process does.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>

namespace nook::bake {

// threads 0: all cores. The calling thread counts as one of them.
template <class Body>
void run_with_threads(std::size_t threads, Body&& body) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : int(threads));
  arena.execute(body);
}

}  // namespace nook::bake
