// The oracle on scenes whose AO is known.
#include "bakers/measure/nnao/oracle_pass.h"

#include <cmath>

#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::measure;
using namespace nook::test;

namespace {

std::vector<float> oracle_ao(Oracle oracle, const bake::nnao::TracedView& view, float radius) {
  const auto context = make_context();
  const GpuView images(context->gl(), view);
  const OraclePass pass(context->gl(), width, height);
  return read_red(context->gl(), pass.draw(oracle, images, radius), width, height);
}

}  // namespace

TEST_CASE("the oracle leaves a plane open, but where the border's depth continues upwards") {
  // Above the upper border the continued depth is nearer than the plane; the radius is 6 pixels there.
  for (const Oracle oracle : all_oracles) {
    const std::vector<float> ao = oracle_ao(oracle, traced(plane(), camera()), 0.3f);
    for (int y = 0; y < height - 8; ++y)
      for (int x = 0; x < width; ++x) {
        const auto i = std::size_t(y) * width + std::size_t(x);
        INFO(oracle_name(oracle) << " at " << x << ' ' << y);
        REQUIRE(ao[i] > 0.985f);
      }
  }
}

TEST_CASE("the oracle agrees with rays in a corner that the screen shows whole") {
  const bake::nnao::TracedView view = traced(corner(), camera());
  const std::vector<float> truth = traced_ao(corner(), view, 0.6f, 256);
  for (const Oracle oracle : all_oracles) {
    const std::vector<float> ao = oracle_ao(oracle, view, 0.6f);
    double squared = 0, bias = 0;
    int count = 0;
    for (int y = height / 4; y < 3 * height / 4; ++y)
      for (int x = width / 4; x < 3 * width / 4; ++x) {
        const auto i = std::size_t(y) * width + std::size_t(x);
        const double error = double(ao[i]) - double(truth[i]);
        squared += error * error;
        bias += error;
        ++count;
      }
    INFO(oracle_name(oracle) << ", mse " << squared / count << ", bias " << bias / count);
    // A thickness of half a radius lets some light pass behind the corner's planes.
    CHECK(squared / count < (oracle == Oracle::solid ? 1e-3 : 4e-3));
    CHECK(std::abs(bias / count) < (oracle == Oracle::solid ? 0.015 : 0.05));
  }
}
