// Times of drawing calls on the GPU that runs them.
#pragma once

#include <glad/gl.h>

#include <functional>

namespace nook::lab {

struct GpuTime {
  double gpu_ms = 0;   // of one call, between two time stamps of the GPU; the median of the batches
  double slowest = 0;  // of the batches, over the median
  double cpu_ms = 0;   // of one call on the thread that makes it; the median of the batches
};

class GpuClock {
 public:
  // The context is OpenGL 3.3 or newer, whose GPU has time stamps; else std::runtime_error.
  // batch_ms: the length of a batch; short calls are repeated to fill it.
  GpuClock(const GladGLContext& gl, int batches, double batch_ms);
  ~GpuClock();
  GpuClock(const GpuClock&) = delete;
  GpuClock& operator=(const GpuClock&) = delete;

  // call makes the same OpenGL calls each time, and prepare, if there is one, runs before each call, outside
  // the times. The first runs are not counted: drivers compile then, and clocks of an idle GPU are low.
  GpuTime time(const std::function<void()>& call, const std::function<void()>& prepare = {}) const;

 private:
  struct Batch {
    double gpu_ms = 0, cpu_ms = 0;  // of one call
  };
  Batch run(const std::function<void()>& call, const std::function<void()>& prepare, int calls) const;
  Batch run_one(const std::function<void()>& call, int calls) const;
  void keep_busy(int loops) const;

  const GladGLContext& gl_;
  int batches_;
  double batch_ms_;
  GLuint queries_[2] = {}, program_ = 0, vertex_array_ = 0, target_ = 0, framebuffer_ = 0;
  GLint loops_at_ = -1;
  int busy_loops_ = 1;  // which keep the GPU busy for busy_ms
};

}  // namespace nook::lab
