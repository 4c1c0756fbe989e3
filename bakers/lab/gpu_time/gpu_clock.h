// Measures the GPU and CPU time of drawing calls.
#pragma once

#include <glad/gl.h>

#include <functional>

namespace nook::lab {

struct GpuTime {
  double gpu_ms = 0;   // per call, between two GPU timestamps; median of the batches
  double slowest = 0;  // time of the slowest batch divided by the median
  double cpu_ms = 0;   // per call on the calling thread; median of the batches
};

class GpuClock {
 public:
  // Requires OpenGL 3.3 or newer and a GPU with timestamps; otherwise throws std::runtime_error. `batch_ms`
  // is the length of a batch. Short calls are repeated to fill it.
  GpuClock(const GladGLContext& gl, int batches, double batch_ms);
  ~GpuClock();
  GpuClock(const GpuClock&) = delete;
  GpuClock& operator=(const GpuClock&) = delete;

  // `call` must make the same OpenGL calls each time. If you give `prepare`, it runs before each call and is
  // not timed. The first runs are not measured, because drivers compile shaders in them and an idle GPU has a
  // low clock rate.
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
  int busy_loops_ = 1;  // number of loops that keeps the GPU busy for busy_ms
};

}  // namespace nook::lab
