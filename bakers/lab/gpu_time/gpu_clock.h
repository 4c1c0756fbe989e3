// Times drawing calls on the GPU that runs them.
#pragma once

#include <glad/gl.h>

#include <functional>

namespace nook::lab {

struct GpuTime {
  double gpu_ms = 0;   // per call, between two time stamps of the GPU; the median of the batches
  double slowest = 0;  // slowest batch over the median
  double cpu_ms = 0;   // per call on the calling thread; the median of the batches
};

class GpuClock {
 public:
  // Needs OpenGL 3.3 or newer and a GPU with time stamps, or throws std::runtime_error. batch_ms: the length
  // of a batch; short calls repeat to fill it.
  GpuClock(const GladGLContext& gl, int batches, double batch_ms);
  ~GpuClock();
  GpuClock(const GpuClock&) = delete;
  GpuClock& operator=(const GpuClock&) = delete;

  // call must make the same OpenGL calls each time. prepare, if there is one, runs before each call and is
  // not timed. The first runs do not count: drivers compile then, and clocks of an idle GPU are low.
  GpuTime time(const std::function<void()>& call, const std::function<void()>& prepare = {}) const;

 private:
  struct Batch {
    double gpu_ms = 0, cpu_ms = 0;  // per call
  };
  Batch run(const std::function<void()>& call, const std::function<void()>& prepare, int calls) const;
  Batch run_one(const std::function<void()>& call, int calls) const;
  void keep_busy(int loops) const;

  const GladGLContext& gl_;
  int batches_;
  double batch_ms_;
  GLuint queries_[2] = {}, program_ = 0, vertex_array_ = 0, target_ = 0, framebuffer_ = 0;
  GLint loops_at_ = -1;
  int busy_loops_ = 1;  // keeps the GPU busy for busy_ms
};

}  // namespace nook::lab
