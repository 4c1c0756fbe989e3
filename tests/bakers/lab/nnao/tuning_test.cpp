// The grid search finds the tuning that made its own truth.
#include "bakers/lab/nnao/tuning.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/lab/nnao/baseline_pass.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

TEST_CASE("the table of tunings is a row for each method of the comparison") {
  std::map<Baseline, int> count, shipped;
  for (const BaselineMethod& method : baseline_methods()) {
    ++(method.shipped ? shipped : count)[method.baseline];
    const BaselineGrid grid = baseline_grid(method.baseline, method.taps);
    const int halves = method.baseline >= Baseline::gtao ? 2 : 1;
    CHECK(grid.groups * grid.steps * halves == method.taps);
    CHECK(method.tuning.radius_scale > 0);
    CHECK(method.tuning.power > 0);
  }
  using enum Baseline;
  CHECK(count == std::map<Baseline, int>{{ssao, 3},
                                         {ssao_plus, 3},
                                         {hbao, 3},
                                         {n8ao, 1},
                                         {s4ao, 1},
                                         {vtk, 1},
                                         {qgis, 1},
                                         {filament, 2},
                                         {gtao, 6},
                                         {bitmask, 6},
                                         {xegtao, 3}});
  CHECK(shipped ==
        std::map<Baseline, int>{{n8ao, 1}, {s4ao, 1}, {vtk, 1}, {qgis, 1}, {filament, 1}, {xegtao, 3}});
}

TEST_CASE("tuning never ends above where it began, and a planted truth is found") {
  const auto context = make_context();
  MeasuredView measured;
  measured.radius = 0.5f;
  measured.view = traced(corner(), camera());
  const BaselineMethod planted{Baseline::ssao_plus, 16, {0.8f, 1.6f, 0.03f}};
  {
    BaselinePass pass(context->gl(), width, height);
    const GpuView images(context->gl(), measured.view);
    AoRequest request;
    request.radius = measured.radius;
    request.max_radius_px = 0.5f * float(height);
    const GLuint texture = pass.draw(planted, images, request, true);
    measured.truth = read_red(context->gl(), texture, width, height);
  }
  const BaselineMethod start{Baseline::ssao_plus, 16, {1.26f, 1.0f, 0.1f}};
  const std::vector<TunedBaseline> tuned =
      tune_baselines(*context, {&measured, 1}, {&start, 1}, [](std::size_t, std::size_t) { return true; });
  REQUIRE(tuned.size() == 1);
  // The corner alone is matched by neighbours on the grid nearly as well: a level of 8 bits, squared, four
  // times.
  CHECK(tuned[0].mse < 4.0 / (255 * 255));
}

TEST_CASE("the grids of the search grow, and a baseline begins within them") {
  for (const Baseline baseline : all_baselines) {
    const TuningPlace first = first_place(baseline);
    CHECK(tuning_at(baseline, first).radius_scale == 1);
    CHECK(tuning_at(baseline, first).power == 1);
    CHECK(axes_at_edge(baseline, first).empty());
    for (std::size_t axis = 0; axis < tuned_axes; ++axis) {
      const std::span<const float> values = axis_values(baseline, axis);
      CHECK(std::ranges::is_sorted(values));
      CHECK(first.at[axis] < int(values.size()));
    }
  }
}

TEST_CASE("a best value that is the last of its grid is named, unless the parameter ends there") {
  TuningPlace place = first_place(Baseline::xegtao);
  place.at = {0, int(axis_values(Baseline::xegtao, 1).size()) - 1,
              int(axis_values(Baseline::xegtao, 2).size()) - 1, 0};
  CHECK(axes_at_edge(Baseline::xegtao, place) == std::vector<std::string>{"radius_scale", "power"});
  place = first_place(Baseline::hbao);
  place.at[2] = 0;
  CHECK(axes_at_edge(Baseline::hbao, place).empty());
  place.at[2] = int(axis_values(Baseline::hbao, 2).size()) - 1;
  CHECK(axes_at_edge(Baseline::hbao, place) == std::vector<std::string>{"shape"});
}
