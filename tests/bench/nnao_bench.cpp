// A frame of the screen-space pass on both paths, 640 x 360, through the C ABI: linear depth of a room with
// balls, normals reconstructed from it. Time is measured around glFinish. CPU counts all threads of the
// process, which on a software renderer hardly depends on the other load of the machine. Both are minima over
// all frames.
#include <benchmark/benchmark.h>
#include <glad/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>
#include <stdexcept>
#include <vector>

#include "platform/platform.h"
#include "tests/gl/chained_descs.h"

namespace {

constexpr int width = 640, height = 360;

void require(nook_result result) {
  if (result != NOOK_OK) throw std::runtime_error(nook_last_message());
}

// For the whole run. Left to the end of the process: the driver may be unloaded before a destructor would
// run.
struct Gl {
  Gl() : context(platform::create_context({})) {
    nook_context_desc context_desc;
    require(nook_context_desc_init(&context_desc));
    nook_context nook = nullptr;
    require(nook_context_create(&context_desc, &nook));
    nook_gl_desc desc;
    require(nook_gl_desc_init(&desc));
    desc.get_proc = platform::Context::loader;
    desc.get_proc_user = context.get();
    require(nook_gl_create(nook, &desc, &handle));
  }
  std::unique_ptr<platform::Context> context;
  nook_gl handle = nullptr;
};
Gl& shared_gl() {
  static Gl* const made = new Gl;
  return *made;
}

constexpr float focal = 1.4f;  // of the projection's y axis

// Metres along the ray through a pixel, its direction scaled to z = -1.
float depth_at(int x, int y) {
  const float ray_x = (2 * (float(x) + 0.5f) / width - 1) * width / (focal * height),
              ray_y = (2 * (float(y) + 0.5f) / height - 1) / focal;
  float nearest = 6 / (1 - 0.3f * ray_x);
  if (ray_y < 0) nearest = std::min(nearest, -0.8f / ray_y);
  for (int i = 0; i < 24; ++i) {
    const float column = float(i % 6), row = float(i / 6), radius = 0.3f;
    const float cx = -2 + 0.9f * column + 0.1f * row, cy = -0.6f + 0.3f * row, depth = 2.2f + 0.7f * row;
    const float a = ray_x * ray_x + ray_y * ray_y + 1, b = ray_x * cx + ray_y * cy + depth;
    const float rest = b * b - a * (cx * cx + cy * cy + depth * depth - radius * radius);
    if (rest > 0) nearest = std::min(nearest, (b - std::sqrt(rest)) / a);
  }
  return nearest;
}

class Pass {
 public:
  Pass(nook_nnao_path path, int taps, int half) : gl_(shared_gl().context->gl()) {
    nook::test::PassDesc desc;
    desc.max_width = width;
    desc.max_height = height;
    desc.taps = taps;
    desc.half_resolution = half;
    desc.debug.path = path;
    require(nook_nnao_create(shared_gl().handle, &desc, &pass_));
    std::vector<float> depth;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) depth.push_back(depth_at(x, y));
    gl_.GenTextures(1, &depth_);
    gl_.BindTexture(GL_TEXTURE_2D, depth_);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, depth.data());
    frame_.width = width;
    frame_.height = height;
    frame_.depth_texture = depth_;
    frame_.depth_kind = NOOK_DEPTH_LINEAR;
    frame_.projection[0] = focal * height / width;
    frame_.projection[5] = focal;
    frame_.projection[10] = frame_.projection[11] = -1;
    frame_.projection[14] = -0.02f;
    frame_.radius = 0.5f;
    frame_.max_radius_px = 0.5f * height;
    draw();  // drivers compile in the first frame
  }
  ~Pass() {
    nook_nnao_destroy(&pass_);
    gl_.DeleteTextures(1, &depth_);
  }
  void draw() {
    require(nook_nnao_render(pass_, &frame_, &frame_));
    gl_.Finish();
  }

 private:
  const GladGLContext& gl_;
  nook_nnao pass_ = nullptr;
  GLuint depth_ = 0;
  nook::test::ScreenFrame frame_;
};

double process_ms() {
  return 1e3 * double(std::clock()) / CLOCKS_PER_SEC;
}
double wall_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

// The two paths take turns, so that both see the same load of the machine.
void paths(benchmark::State& state) {
  const int taps = int(state.range(0)), half = int(state.range(1));
  Pass fragment(NOOK_NNAO_PATH_FRAGMENT, taps, half), compute(NOOK_NNAO_PATH_COMPUTE, taps, half);
  double least_wall[2] = {1e9, 1e9}, least_work[2] = {1e9, 1e9};
  for (auto _ : state)
    for (Pass* pass : {&fragment, &compute}) {
      const bool second = pass == &compute;
      const double wall = wall_ms(), work = process_ms();
      pass->draw();
      least_work[second] = std::min(least_work[second], process_ms() - work);
      least_wall[second] = std::min(least_wall[second], wall_ms() - wall);
    }
  state.counters["fragment_ms"] = least_wall[0];
  state.counters["compute_ms"] = least_wall[1];
  state.counters["ratio"] = least_wall[1] / least_wall[0];
  state.counters["fragment_cpu_ms"] = least_work[0];
  state.counters["compute_cpu_ms"] = least_work[1];
  state.counters["cpu_ratio"] = least_work[1] / least_work[0];
}
BENCHMARK(paths)
    ->Name("nnao_paths")
    ->ArgNames({"taps", "half"})
    ->ArgsProduct({{16, 32, 64, 128, 256}, {0, 1}})
    ->Iterations(12)
    ->Unit(benchmark::kMillisecond);

}  // namespace
