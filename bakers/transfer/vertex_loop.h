// The loop over vertices of a bake.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::transfer {

// Worker threads call the function, but never two at the same time. Return false to stop.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Runs body(vertex, workspace) for each vertex, on all threads, and counts the vertices for the progress.
// Blocks start at multiples of `block`. All vertices of a block use the same workspace.
class VertexLoop {
 public:
  static constexpr std::size_t block = 64;

  // `total` is the number of vertices over all runs.
  VertexLoop(std::size_t total, const Progress& progress) : total_(total), progress_(progress) {}

  // Throws Failure(CANCELLED) if the progress callback returns false.
  template <class Workspace, class Body>
  void run(std::size_t vertices, Body&& body) {
    tbb::parallel_for(
        std::size_t(0), (vertices + block - 1) / block,
        [&](std::size_t index) {
          const FlushDenormals flush;
          Workspace work;
          const std::size_t first = index * block, end = std::min(first + block, vertices);
          for (std::size_t v = first; v < end && !cancelled_; ++v) body(v, work);
          if (!progress_) return;
          const std::lock_guard lock(mutex_);
          done_ += end - first;
          if (!cancelled_ && !progress_(done_, total_)) cancelled_ = true;
        },
        tbb::simple_partitioner());
    if (cancelled_)
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu vertices done)", done_,
                    total_);
  }

 private:
  std::size_t total_, done_ = 0;
  const Progress& progress_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
};

}  // namespace nook::bake::transfer
