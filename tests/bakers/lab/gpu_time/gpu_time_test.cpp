// The clock and what it times, on the software renderer: what is drawn and how often, not how long it takes.
#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/lab/gpu_time/crowd.h"
#include "bakers/lab/gpu_time/timed_rows.h"
#include "bakers/lab/gpu_time/whole_image.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;

TEST_CASE("a clock prepares each call, and its times are of one call") {
  const std::unique_ptr<platform::Context> context = platform::create_context({});
  const GladGLContext& gl = context->gl();
  const GpuClock clock(gl, 3, 1);
  int calls = 0, prepared = 0;
  bool in_turn = true;
  const GpuTime time = clock.time(
      [&] {
        in_turn = in_turn && prepared == calls + 1;
        ++calls;
      },
      [&] { ++prepared; });
  CHECK(in_turn);
  CHECK(calls == prepared);
  // Two runs of one call, one batch that warms up and three that count.
  CHECK(calls >= 6);
  CHECK(time.gpu_ms >= 0);
  CHECK(time.slowest >= 1);
  // The call does nothing, so that its share of a batch is less than the millisecond of the batch.
  CHECK(time.cpu_ms < 1);
  CHECK(gl.GetError() == GL_NO_ERROR);
}

TEST_CASE("a whole image is drawn by the body that it is given") {
  const std::unique_ptr<platform::Context> context = platform::create_context({});
  const GladGLContext& gl = context->gl();
  constexpr int width = 6, height = 4;
  const WholeImage image(gl, width, height, "float quarter() { return 0.25; }\n",
                         "  colour = vec3(at, quarter());\n");
  image.draw();
  std::vector<float> drawn(std::size_t(4) * width * height);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, drawn.data());
  // Half floats below 1 have steps of 1/2048.
  constexpr float bound = 1.0f / 2048;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float* const pixel = &drawn[std::size_t(4) * (std::size_t(y) * width + std::size_t(x))];
      CHECK(std::abs(pixel[0] - (float(x) + 0.5f) / width) <= bound);
      CHECK(std::abs(pixel[1] - (float(y) + 0.5f) / height) <= bound);
      CHECK(pixel[2] == 0.25f);
    }
  CHECK(gl.GetError() == GL_NO_ERROR);
}

TEST_CASE("a crowd stands on the ground, and its neighbours darken it") {
  const std::unique_ptr<platform::Context> context = platform::create_context({});
  const NookGl nook(*context);
  const auto mean_ao = [&](std::uint32_t neighbours) {
    Crowd crowd(nook, MANNEQUIN, 4, 0.8f);
    crowd.pose(neighbours);
    succeed(nook_scene_update(crowd.scene()));
    std::vector<float> ao(crowd.vertex_count());
    succeed(nook_scene_read(crowd.scene(), crowd.bodies().front(), NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT,
                            ao.data(), std::uint32_t(ao.size()), 0));
    double sum = 0;
    for (const float value : ao) sum += value;
    return sum / double(ao.size());
  };
  const double alone = mean_ao(0), among_others = mean_ao(3);
  CHECK(alone > 0.3);
  CHECK(among_others < alone - 0.005);
}

TEST_CASE("rows have names of their own, and rows that are left out are not timed") {
  const std::unique_ptr<platform::Context> context = platform::create_context({});
  const NookGl nook(*context);
  const GpuClock clock(context->gl(), 1, 0);
  const std::vector<std::string> wanted = {"NNAO 9", "hbao 16", "1 character, 0 neighbours, tier 43",
                                           "world, 100 bodies, cutoff_error 1/256, half resolution",
                                           "grid of 12 lobes, irradiance by bands"};
  std::map<std::string, int> asked;
  const Timing timing{*context, nook, clock, 48, 32, [&](const std::string& name) {
                        ++asked[name];
                        return std::ranges::find(wanted, name) != wanted.end();
                      }};
  std::vector<std::string> timed;
  for (const std::vector<TimedRow>& rows : {time_screen(timing), time_characters(timing, MANNEQUIN),
                                            time_world(timing, MANNEQUIN), time_probes(timing)})
    for (const TimedRow& row : rows) timed.push_back(row.name);
  CHECK(timed == wanted);
  // Some rows ask before they make their pass, and again before it is timed.
  for (const auto& [name, times] : asked) {
    INFO(name);
    CHECK(times <= (std::ranges::find(wanted, name) != wanted.end() ? 2 : 1));
  }
  CHECK(asked.size() > 60);
  CHECK(context->gl().GetError() == GL_NO_ERROR);
}
