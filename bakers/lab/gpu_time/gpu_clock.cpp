#include "bakers/lab/gpu_time/gpu_clock.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "platform/program.h"
#include "platform/stopwatch.h"

namespace nook::lab {
namespace {

constexpr int max_calls = 1000;  // per batch
// Before each batch, other work keeps the GPU busy for this long. In this time, the CPU submits the calls of
// the batch. The GPU therefore does not wait for calls between the two timestamps. If the CPU needs longer
// than this to submit a batch, the measured time includes the waits.
constexpr double busy_ms = 8;
constexpr int busy_side = 64, max_busy_loops = 1 << 20;

const char vertex_text[] =
    "#version 330 core\n"
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1), 0, 1); }\n";
const char fragment_text[] =
    "#version 330 core\n"
    "uniform int loops; out vec4 result;\n"
    "void main() {\n"
    "  vec4 x = gl_FragCoord;\n"
    "  for (int i = 0; i < loops; ++i) x = fract(x * 1.37 + x.yzwx);\n"
    "  result = x;\n"
    "}\n";

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

}  // namespace

GpuClock::GpuClock(const GladGLContext& gl, int batches, double batch_ms)
    : gl_(gl), batches_(batches), batch_ms_(batch_ms) {
  GLint bits = 0;
  if (gl.QueryCounter) gl.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  if (bits == 0) throw std::runtime_error("GpuClock: this OpenGL has no time stamps; OpenGL 3.3 is needed");
  gl.GenQueries(2, queries_);
  program_ = platform::link_program(gl, {vertex_text}, {fragment_text});
  loops_at_ = gl.GetUniformLocation(program_, "loops");
  gl.GenVertexArrays(1, &vertex_array_);
  gl.GenTextures(1, &target_);
  gl.BindTexture(GL_TEXTURE_2D, target_);
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, busy_side, busy_side, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  gl.GenFramebuffers(1, &framebuffer_);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target_, 0);
  // Doubles the number of loops until they take long enough. The first, short runs wake the GPU up.
  while (busy_loops_ < max_busy_loops && run_one([&] { keep_busy(busy_loops_); }, 1).gpu_ms < busy_ms)
    busy_loops_ *= 2;
}

GpuClock::~GpuClock() {
  gl_.DeleteFramebuffers(1, &framebuffer_);
  gl_.DeleteTextures(1, &target_);
  gl_.DeleteVertexArrays(1, &vertex_array_);
  gl_.DeleteProgram(program_);
  gl_.DeleteQueries(2, queries_);
}

void GpuClock::keep_busy(int loops) const {
  gl_.UseProgram(program_);
  gl_.Uniform1i(loops_at_, loops);
  gl_.BindVertexArray(vertex_array_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, busy_side, busy_side);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
}

GpuClock::Batch GpuClock::run_one(const std::function<void()>& call, int calls) const {
  gl_.QueryCounter(queries_[0], GL_TIMESTAMP);
  platform::Stopwatch watch;
  for (int i = 0; i < calls; ++i) call();
  const double cpu_ms = watch.lap_ms();
  gl_.QueryCounter(queries_[1], GL_TIMESTAMP);
  GLuint64 begin = 0, end = 0;
  gl_.GetQueryObjectui64v(queries_[0], GL_QUERY_RESULT, &begin);
  gl_.GetQueryObjectui64v(queries_[1], GL_QUERY_RESULT, &end);
  return {1e-6 * double(end - begin) / calls, cpu_ms / calls};
}

GpuClock::Batch GpuClock::run(const std::function<void()>& call, const std::function<void()>& prepare,
                              int calls) const {
  if (!prepare) {
    gl_.Finish();
    keep_busy(busy_loops_);
    return run_one(call, calls);
  }
  Batch sum;
  for (int i = 0; i < calls; ++i) {
    prepare();
    gl_.Finish();
    keep_busy(busy_loops_);
    const Batch one = run_one(call, 1);
    sum.gpu_ms += one.gpu_ms / calls;
    sum.cpu_ms += one.cpu_ms / calls;
  }
  return sum;
}

GpuTime GpuClock::time(const std::function<void()>& call, const std::function<void()>& prepare) const {
  run(call, prepare, 1);
  const Batch first = run(call, prepare, 1);
  const double first_ms = std::max({first.gpu_ms, first.cpu_ms, 1e-3}) + (prepare ? busy_ms : 0);
  const int calls = int(std::clamp(batch_ms_ / first_ms, 1.0, double(max_calls)));
  run(call, prepare, calls);
  std::vector<double> gpu, cpu;
  for (int i = 0; i < batches_; ++i) {
    const Batch batch = run(call, prepare, calls);
    gpu.push_back(batch.gpu_ms);
    cpu.push_back(batch.cpu_ms);
  }
  GpuTime time;
  time.gpu_ms = median(gpu);
  time.cpu_ms = median(cpu);
  time.slowest = time.gpu_ms > 0 ? *std::ranges::max_element(gpu) / time.gpu_ms : 1;
  return time;
}

}  // namespace nook::lab
