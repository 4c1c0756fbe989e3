// The loop over vertices of a bake.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::transfer {

// Returns false to stop. Worker threads call it, one call at a time.
using Progress = std::function<bool(std::size_t done, std::size_t total)>;

// Runs body(vertex, workspace) for all vertices on all threads, and counts them for the progress; each thread
// reuses a workspace.
class VertexLoop {
 public:
  VertexLoop(std::size_t vertices, std::size_t passes, const Progress& progress)
      : vertices_(vertices), total_(vertices * passes), progress_(progress) {}

  // Throws Failure(CANCELLED) if the progress returns false.
  template <class Workspace, class Body>
  void run(Body&& body) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, vertices_, 64),
        [&](const auto& range) {
          const FlushDenormals flush;
          Workspace work;
          for (std::size_t v = range.begin(); v < range.end() && !cancelled_; ++v) body(v, work);
          if (!progress_) return;
          const std::lock_guard lock(mutex_);
          done_ += range.size();
          if (!cancelled_ && !progress_(done_, total_)) cancelled_ = true;
        },
        tbb::simple_partitioner());
    if (cancelled_)
      throw Failure(NOOK_ERROR_CANCELLED, "cancelled while ray tracing (%zu of %zu vertices done)", done_,
                    total_);
  }

 private:
  std::size_t vertices_, total_, done_ = 0;
  const Progress& progress_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
};

}  // namespace nook::bake::transfer
