// All methods over one small view.
#include "bakers/lab/nnao/screen_comparison.h"

#include <cmath>
#include <set>

#include "bakers/lab/nnao/baseline_pass.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/measure/nnao/small_scenes.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::lab;
using namespace nook::measure;
using namespace nook::test;

namespace {

MeasuredView measured_corner() {
  TruthSettings settings;
  settings.width = width;
  settings.height = height;
  settings.rays = 64;
  return measure_view(bake::RayScene(corner()), "corner", camera(), settings);
}

}  // namespace

TEST_CASE("a slid image shows the same surfaces one pixel aside") {
  const MeasuredView measured = measured_corner();
  for (std::size_t i = 0; i + 1 < measured.view.depth.size(); ++i)
    if (i % width != width - 1)
      REQUIRE(std::abs(measured.slid.depth[i] - measured.view.depth[i + 1]) < 1e-4f);  // rounding of rays
}

TEST_CASE("the truth's noise is what its rays promise") {
  // A mean of 64 stratified yes-or-no rays: below the 1/4 / 64 of independent ones, above none.
  const MeasuredView measured = measured_corner();
  CHECK(measured.noise > 0);
  CHECK(measured.noise < 0.25 / 64);
}

TEST_CASE("a comparison has every method blurred and raw, with sane numbers") {
  const auto context = make_context();
  const MeasuredView measured = measured_corner();
  ComparisonSettings settings;
  settings.request.max_radius_px = 0.5f * float(height);
  const Comparison comparison = compare(
      *context, {&measured, 1}, settings,
      [](const std::string& method, int taps) { return method == "nnao" && taps == 16; },
      [](std::size_t, std::size_t) { return true; });
  CHECK(comparison.rows.size() == 2 * (10 + baseline_methods().size()));
  REQUIRE(comparison.images.size() == 1);
  CHECK(comparison.images[0].ao.size() == measured.truth.size());
  std::set<std::string> names;
  for (const ComparisonRow& row : comparison.rows) {
    INFO(row.method << ' ' << row.taps << ' ' << row.blurred);
    names.insert(row.method);
    REQUIRE(row.views.size() == 1);
    const Measurement& one = row.views[0];
    CHECK(one.error.mse() > 0);
    CHECK(one.error.mse() < 0.3);
    CHECK(one.error.ssim() <= 1);
    CHECK(one.calibration.largest_bias() >= 0);
    CHECK(one.mean_flicker() >= 0);
    // At half resolution a quarter of the pixels have taps.
    CHECK(row.fetches >= row.taps / 4);
    CHECK(one.median_ms() > 0);
    if (!row.blurred) CHECK(row.denoiser == "none");
  }
  // Three of the library, eleven baselines, six with the settings that are shipped.
  CHECK(names.size() == 20);
  // Twice the same view is the view.
  const ComparisonRow& first = comparison.rows[0];
  const std::size_t twice[] = {0, 0};
  CHECK(std::abs(pooled(first, twice).error.mse() - first.views[0].error.mse()) < 1e-12);
  CHECK(pooled(first, twice).border.rim() == Approx(first.views[0].border.rim()));
  CHECK_THROWS_AS(compare(
                      *context, {&measured, 1}, settings, [](const std::string&, int) { return false; },
                      [](std::size_t, std::size_t) { return false; }),
                  Failure);
}

TEST_CASE("chosen methods are measured with chosen taps, and the oracle where it is named") {
  const auto context = make_context();
  const MeasuredView measured = measured_corner();
  ComparisonSettings settings;
  settings.methods = {"gtao:16", "hbao", "oracle"};
  settings.raw = false;
  settings.request.max_radius_px = 0.5f * float(height);
  const Comparison comparison = compare(
      *context, {&measured, 1}, settings, [](const std::string&, int) { return false; },
      [](std::size_t, std::size_t) { return true; });
  std::vector<std::string> rows;
  for (const ComparisonRow& row : comparison.rows)
    rows.push_back(row.method + ":" + std::to_string(row.taps) + (row.blurred ? "" : ":raw"));
  CHECK(rows == std::vector<std::string>{"hbao:16", "hbao:32", "hbao:64", "gtao:16", "oracle:1024:raw"});
  CHECK(comparison.rows.back().views[0].flicker.empty());
}
