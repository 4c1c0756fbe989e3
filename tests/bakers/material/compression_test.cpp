#include "bakers/material/compression.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bakers/material/btf_error.h"
#include "bakers/material/raw_material.h"
#include "bakers/material/raw_relief.h"
#include "bakers/material/visibility_values.h"
#include "bakers/measure/material/material_report.h"
#include "bakers/measure/material/view_errors.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/material/material_file.h"
#include "sdk/src/material/reflectance.h"
#include "sdk/src/material/tables.h"
#include "tests/bakers/material/small_material.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::material;
using nook::material::Material;
using nook::material::VisibilityForm;

namespace {

CompressionSettings small_settings(Method method) {
  CompressionSettings s;
  s.method = method;
  s.rank_light = 8;
  s.rank_view = 16;
  s.rank_x = 8;
  s.rank_y = 8;
  s.votf_rank_x = 8;
  s.votf_rank_y = 12;
  s.map_side = 16;
  return s;
}

double error_db(const RawMaterial& raw, const Material& m) {
  return measure_btf(raw, {m.light_basis.begin(), m.light_basis.end()}, m.btf).se_db();
}

std::string refusal(const RawMaterial& raw, const CompressionSettings& s) {
  try {
    check_settings(s, raw);
  } catch (const Failure& e) {
    return e.what();
  }
  return "";
}

}  // namespace

TEST_CASE(
    "all three methods give materials whose size is the formula's, and K-CTA lies between CTA and N-SVD") {
  const RawMaterial raw = test::small_material();
  double se[3];
  for (const Method method : {Method::n_svd, Method::cta, Method::k_cta}) {
    const CompressionSettings s = small_settings(method);
    const Material m = nook::material::quantise(compress(raw, s));
    const std::size_t clusters = method == Method::n_svd ? 1 : 4, k = method == Method::k_cta ? 3 : 1;
    const std::size_t view_rank = method == Method::n_svd ? 16 : 4;
    // Half floats of cores, x and y bases of each cluster, the light basis, K R_v numbers and K indices a
    // view.
    const std::size_t index = clusters == 1 ? 0 : 24 * k;
    const std::size_t btf =
        2 * (18 * 8 + clusters * (8 * view_rank * 8 * 8 + 12 * 8 + 16 * 8) + 24 * k * view_rank) + index;
    const std::size_t votf =
        2 * (clusters * (view_rank * 8 * 12 + 12 * 8 + 16 * 12) + 24 * k * view_rank) + index;
    CHECK(nook::material::compressed_bytes(m) == btf + votf);
    CHECK(m.btf.map.side == (method == Method::k_cta ? 16u : 0u));
    CHECK(m.visibility == VisibilityForm::distance);
    se[int(method)] = error_db(raw, m);
  }
  CHECK(se[int(Method::k_cta)] > se[int(Method::cta)]);
  // 12 coefficients of a view against 16: what N-SVD is ahead of K-CTA is small, if anything.
  CHECK(se[int(Method::n_svd)] > se[int(Method::cta)]);
}

TEST_CASE("K-CTA with K = 1 is as good as CTA") {
  const RawMaterial raw = test::small_material();
  CompressionSettings s = small_settings(Method::k_cta);
  s.mixture = 1;
  const double k_cta = error_db(raw, compress(raw, s));
  s.method = Method::cta;
  // Both descend to the same kind of optimum from the same seeds; they stop at a change of 1e-4.
  CHECK(k_cta == Approx(error_db(raw, compress(raw, s))).margin(0.5));
}

TEST_CASE("at full ranks nothing is lost but half floats") {
  const RawMaterial raw = test::small_material(4, 8, 6, 5);
  CompressionSettings s;
  s.method = Method::n_svd;
  s.rank_light = 12;
  s.rank_view = 8;
  s.rank_x = s.votf_rank_x = 6;
  s.rank_y = s.votf_rank_y = 5;
  const Material m = nook::material::quantise(compress(raw, s));
  // Rounding to 11 bits is an error of 2^-12 / sqrt(3) of each number: 77 dB; the core's small entries lose
  // less.
  CHECK(error_db(raw, m) > 70);
  CHECK(count_error_texels(raw, m.votf, m.visibility) == 0);
}

TEST_CASE("the resampled map decodes to the views' own images where it meets them") {
  const RawMaterial raw = test::small_material();
  CompressionSettings s = small_settings(Method::k_cta);
  s.map_side = 256;
  Material m = compress(raw, s);
  const double own = error_db(raw, m);
  // The rows of the map's nearest cells in the place of the views' own.
  for (std::size_t v = 0; v < raw.views.size(); ++v) {
    const float scale = 1 / (1 + raw.views[v].z);
    const auto cell = [&](float at) {
      return std::min(std::size_t((0.5f * at * scale + 0.5f) * 256), std::size_t{255});
    };
    const std::size_t row = cell(raw.views[v].y) * 256 + cell(raw.views[v].x);
    for (std::size_t i = 0; i < 3; ++i)
      m.btf.rows.membership[3 * v + i] = m.btf.map.rows.membership[3 * row + i];
    for (std::size_t i = 0; i < 12; ++i)
      m.btf.rows.coefficients[12 * v + i] = m.btf.map.rows.coefficients[12 * row + i];
  }
  // A cell's centre is up to 0.4 degrees off, which alone moves images by an error of about -46 dB, and the
  // greedy search may take other clusters than the fit kept. Wrong directions or clusters would leave less
  // than 15 dB.
  CHECK(error_db(raw, m) > own - 3);
}

TEST_CASE("a view that turns changes what K-CTA decodes about as smoothly as what N-SVD decodes") {
  const RawMaterial raw = test::small_material(6, 40);
  // The largest root mean square change of a step of half a degree, over two arcs.
  const auto largest_step = [&](Method method, std::uint32_t map_side) {
    CompressionSettings s = small_settings(method);
    s.mixture = 3;
    s.map_side = map_side;
    s.is_cta_mapped = true;
    s.visibility = VisibilityForm::none;
    const auto tables = nook::material::make_tables(compress(raw, s), {}, nook::default_memory(), 256);
    double largest = 0;
    for (const float aside : {0.1f, -0.3f}) {
      std::vector<float> before;
      for (int step = -80; step <= 80; ++step) {
        const float angle = float(step) * 0.0087266f;
        std::vector<float> now;
        for (std::uint32_t i = 0; i < raw.texels(); ++i) {
          nook::material::Sample sample;
          sample.u = (float(i % raw.width) + 0.5f) / float(raw.width);
          sample.v = (float(i / raw.width) + 0.5f) / float(raw.height);
          sample.view = normalised({std::sin(angle), aside, std::cos(angle)});
          sample.light = normalised({0.3f, 0.2f, 1});
          now.push_back(evaluate_btf(tables, sample).green);
        }
        double square = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
          square += double((now[i] - before[i]) * (now[i] - before[i]));
        largest = std::max(largest, square / double(now.size()));
        before = std::move(now);
      }
    }
    return std::sqrt(largest);
  };
  const double n_svd = largest_step(Method::n_svd, 0);
  INFO("N-SVD " << n_svd << ", K-CTA with a map " << largest_step(Method::k_cta, 256) << ", of 64 cells "
                << largest_step(Method::k_cta, 64) << ", without " << largest_step(Method::k_cta, 0));
  // Where the map's clusters change, both sets are near the data, but not the same.
  CHECK(largest_step(Method::k_cta, 256) < 1.5 * n_svd);
  // A small map is refined where it is decoded: read as it is, its cells of 3.6 degrees would be steps seven
  // times as large as a step of half a degree.
  CHECK(largest_step(Method::k_cta, 64) < 1.5 * n_svd);
  // Where cells of CTA meet whose single clusters differ, nothing of the one is left in the other.
  CHECK(largest_step(Method::cta, 64) > 1.5 * largest_step(Method::k_cta, 64));
  // Mixed linearly from the same views as N-SVD is.
  CHECK(largest_step(Method::k_cta, 0) < 1.5 * n_svd);
}

TEST_CASE("the same seed gives the same bytes on one thread and on four") {
  const RawMaterial raw = test::small_material();
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return nook::material::write_material(compress(raw, small_settings(Method::k_cta)));
  };
  CHECK(with_threads(1) == with_threads(4));
}

TEST_CASE("ranks, clusters and mixtures that do not fit are named") {
  const RawMaterial raw = test::small_material();
  const auto with = [&](auto change) {
    CompressionSettings s = small_settings(Method::k_cta);
    change(s);
    return refusal(raw, s);
  };
  CHECK(with([](auto&) {}).empty());
  CHECK(with([](auto& s) { s.rank_light = 19; }).find("light rank is 19") != std::string::npos);
  CHECK(with([](auto& s) { s.rank_view = 25; }).find("view rank is 25") != std::string::npos);
  CHECK(with([](auto& s) { s.rank_x = 13; }).find("x rank is 13") != std::string::npos);
  CHECK(with([](auto& s) { s.rank_y = 0; }).find("y rank is 0") != std::string::npos);
  CHECK(with([](auto& s) { s.votf_rank_y = 17; }).find("VOTF's y rank is 17") != std::string::npos);
  CHECK(with([](auto& s) { s.clusters = 25; }).find("clusters is 25") != std::string::npos);
  CHECK(with([](auto& s) { s.mixture = 5; }).find("K is 5") != std::string::npos);
  CHECK(with([](auto& s) { s.map_side = 1000; }).find("1000 cells") != std::string::npos);
}

TEST_CASE("ranks by threshold keep each mode's error, in multiples of four") {
  const RawMaterial raw = test::small_material();
  const CompressionSettings s = ranks_by_threshold(raw, 0.01, {});
  for (const std::uint32_t rank :
       {s.rank_light, s.rank_view, s.rank_x, s.rank_y, s.votf_rank_x, s.votf_rank_y})
    CHECK((rank % 4 == 0 || rank == 18));
  CHECK(s.cluster_count() == std::max(s.rank_view / 4, 1u));
  CompressionSettings n_svd = s;
  n_svd.method = Method::n_svd;
  n_svd.visibility = VisibilityForm::none;
  // The error of all modes together is at most the sum of theirs (De Lathauwer et al. 2000, property 10).
  CHECK(error_db(raw, compress(raw, n_svd)) > 10 * std::log10(1 / 0.04));
}

TEST_CASE("compression can be stopped, and a material without a mask has no VOTF") {
  RawMaterial raw = test::small_material();
  const CompressionSettings s = small_settings(Method::k_cta);
  int calls = 0;
  CHECK_THROWS_AS(compress(raw, s, [&](const char*, std::size_t, std::size_t) { return ++calls < 3; }),
                  Failure);
  raw.mask.clear();
  CHECK(compress(raw, s).visibility == VisibilityForm::none);
}

TEST_CASE("the visibility mapping has half a texel, or what the settings say") {
  using nook::material::VisibilityForm;
  // The scale of distances is 2.5 texels of 96.
  const auto at_96 = default_mapping(VisibilityForm::distance, 96, 64);
  CHECK(at_96.threshold == Approx(std::tanh(0.5 / 2.5)));
  CHECK(at_96.weight == Approx(1 / std::tanh(0.5 / 2.5)));
  CHECK(default_mapping(VisibilityForm::binary, 96, 96).threshold == 0.5f);
  const RawMaterial raw = test::small_material();
  CompressionSettings s;
  s.method = Method::n_svd;
  s.rank_light = s.rank_view = s.rank_x = s.rank_y = s.votf_rank_x = s.votf_rank_y = 4;
  s.mapping = nook::material::paper_mapping(VisibilityForm::distance);
  const auto material = nook::material::quantise(compress(raw, s));
  CHECK(material.mapping.threshold == 0.05f);
  CHECK(material.mapping.weight == 12);
  s.mapping->weight = -1;
  CHECK_THROWS_AS(compress(raw, s), Failure);
}

TEST_CASE("targets of a refit keep what is right by a margin and push the rest beyond it") {
  // The threshold is 0, the margin 0.8 of the smallest value, 0.4.
  const std::vector<float> values{1, -1, 0.5f, -0.5f, 0.5f, 1};
  const std::vector<float> decoded{1.2f, -0.7f, 0.3f, 0.2f, -0.1f, 9};
  const std::vector<float> wanted{1.2f, -0.7f, 0.5f, -1.0f, 0.9f, 1.5f};
  const std::vector<float> targets = margin_targets(values, decoded, 0);
  for (std::size_t i = 0; i < values.size(); ++i) CHECK(targets[i] == Approx(wanted[i]));
  // The same shifted by a threshold of 0.5, as masks have it.
  std::vector<float> shifted = values, shifted_decoded = decoded;
  for (float& value : shifted) value += 0.5f;
  for (float& value : shifted_decoded) value += 0.5f;
  const std::vector<float> again = margin_targets(shifted, shifted_decoded, 0.5f);
  for (std::size_t i = 0; i < values.size(); ++i) CHECK(again[i] == Approx(wanted[i] + 0.5f));
}

TEST_CASE("refits of the VOTF lower its error texels in either form") {
  const RawMaterial raw = test::small_material();
  for (const auto form : {nook::material::VisibilityForm::distance, nook::material::VisibilityForm::binary}) {
    CompressionSettings s;
    s.rank_light = s.rank_x = s.rank_y = 4;
    s.rank_view = 8;
    s.cluster_rank_view = 2;
    s.mixture = 2;
    s.votf_rank_x = s.votf_rank_y = 4;
    s.map_side = 0;
    s.visibility = form;
    s.votf_refits = 0;
    const std::vector<float> values = votf_values(raw, form);
    const std::size_t before = count_error_texels(raw, compress_votf(raw, values, s), form);
    s.votf_refits = 2;
    const std::size_t after = count_error_texels(raw, compress_votf(raw, values, s), form);
    CHECK(before > 0);
    CHECK(after < before);
  }
}

namespace {

// A painted surface of heights 0.03 + 0.02 cos x, which no view up to 75 degrees hides from itself: 3.7 times
// its slope of 0.13 is below 1. Its radiance is the paint's, from everywhere.
struct Painted {
  static constexpr std::uint32_t side = 24;
  static constexpr float turn = 6.2831853f;

  static float height(float x) { return 0.03f + 0.02f * std::cos(turn * x); }
  static float paint(std::size_t row, float x, float y) {
    return 1 + 0.1f * float(row) + 0.4f * std::cos(turn * (2 * x + y)) + 0.3f * std::sin(turn * (y - x));
  }
  static float middle(std::size_t texel) { return (float(texel) + 0.5f) / float(side); }

  static RawMaterial seen_from(std::vector<Vec3> views) {
    RawMaterial raw;
    raw.lights = spiral_directions(4);
    raw.views = std::move(views);
    raw.width = raw.height = side;
    for (std::size_t row = 0; row < raw.light_rows(); ++row)
      for (const Vec3 view : raw.views)
        for (std::size_t x = 0; x < side; ++x)
          for (std::size_t y = 0; y < side; ++y) {
            float z = 0;  // a contraction, so that it converges
            for (int i = 0; i < 60; ++i) z = height(middle(x) + z * view.x / view.z);
            raw.btf.push_back(paint(row, middle(x) + z * view.x / view.z, middle(y) + z * view.y / view.z));
          }
    return raw;
  }
};

}  // namespace

TEST_CASE("views of a painted relief come back aligned: every view shows the paint of its points") {
  const RawMaterial raw = Painted::seen_from(spiral_directions(24));
  std::vector<float> heights(raw.texels());
  for (std::size_t t = 0; t < raw.texels(); ++t)
    heights[t] = Painted::height(Painted::middle(t / Painted::side));
  const nook::material::Relief known = relief_of_heights(raw, heights, 16);
  std::vector<float> moved = raw.btf;
  move_to_relief(raw, known, moved);
  double square = 0;
  for (std::size_t i = 0; i < moved.size(); ++i) {
    const std::size_t t = i % raw.texels(), row = i / raw.texels() / raw.views.size();
    const float paint =
        Painted::paint(row, Painted::middle(t / Painted::side), Painted::middle(t % Painted::side));
    square += std::pow(double(moved[i]) - double(paint), 2);
  }
  // Linear filters of 24 texels on waves of 12 and 24 leave up to (2 pi / 12)^2 / 8 of 0.4: 0.014.
  CHECK(std::sqrt(square / double(moved.size())) < 0.014);

  std::vector<float> still = raw.btf;
  move_to_relief(raw, nook::material::Relief(), still);
  CHECK(still == raw.btf);
}

TEST_CASE("an estimated relief is the planted one, and views between the samples are sharper with it") {
  const RawMaterial raw = Painted::seen_from(spiral_directions(24)),
                    unseen = Painted::seen_from(spiral_directions(17));
  const nook::material::Relief found = estimate_relief(raw);
  REQUIRE(found.steps > 0);
  double mean = 0;
  for (std::size_t t = 0; t < raw.texels(); ++t)
    mean += std::abs(double(found.low) + double(found.levels[t] * (found.high - found.low)) / 255 -
                     double(Painted::height(Painted::middle(t % Painted::side)))) /
            double(raw.texels());
  CHECK(mean < 0.01);  // the spacing of the heights that are tried; a quarter of a texel
  CompressionSettings s = small_settings(Method::k_cta);
  s.rank_light = 6;
  s.visibility = VisibilityForm::none;
  const double without = measure_unseen(unseen, compress(raw, s)).se_db;
  s.relief = ReliefSource::estimated;
  // Without a relief waves of 12 texels move by up to 4 between the views.
  CHECK(measure_unseen(unseen, compress(raw, s)).se_db > without + 6);
}

TEST_CASE("known heights are used as planted, and numbers that are not heights are refused") {
  const auto refused = [](const RawMaterial& raw, const char* why) {
    try {
      known_relief(raw);
    } catch (const Failure& failure) {
      return std::string(failure.what()).find(why) != std::string::npos;
    }
    return false;
  };
  RawMaterial raw = Painted::seen_from(spiral_directions(24));
  CHECK(refused(raw, "not known"));
  for (std::size_t t = 0; t < raw.texels(); ++t)
    raw.heights.push_back(Painted::height(Painted::middle(t / Painted::side)));
  const nook::material::Relief found = known_relief(raw);
  REQUIRE(found.steps > 0);
  for (std::size_t t = 0; t < raw.texels(); ++t)
    // Smoothed over no more than one texel, which takes 3.4 % from waves of 24 texels.
    CHECK(found.low + float(found.levels[t]) * (found.high - found.low) / 255 ==
          Approx(Painted::height(Painted::middle(t % Painted::side))).margin(0.001));
  raw.heights.pop_back();
  CHECK(refused(raw, "575 heights, need 576"));
  raw.heights.push_back(std::nanf(""));
  CHECK(refused(raw, "out of range"));
}

TEST_CASE("ranks by threshold come from the views on the relief") {
  RawMaterial raw = Painted::seen_from(spiral_directions(24));
  for (std::size_t t = 0; t < raw.texels(); ++t)
    raw.heights.push_back(Painted::height(Painted::middle(t / Painted::side)));
  const MovedMaterial moved = move_views(raw, ReliefSource::known);
  REQUIRE(moved.relief.moves());
  // Linear filters leave 1e-4 of the squares.
  const CompressionSettings still = ranks_by_threshold(raw, 2e-4, {}),
                            on_relief = ranks_by_threshold(moved.or_still(raw), 2e-4, {});
  // All views show the same paint.
  CHECK(on_relief.rank_view == 4);
  CHECK(still.rank_view > 4);
  CHECK_FALSE(move_views(raw, ReliefSource::none).relief.moves());
}

namespace {

// A wall over all y, 0.3 tiles high, from x = 0.25 to 0.75 of the tile: half a tile of ground lies between
// two walls, and views across it beyond 59 degrees see none of it.
struct Walled {
  static constexpr std::uint32_t side = 48;
  static constexpr float low_x = 0.25f, high_x = 0.75f, top = 0.3f;

  static float middle(std::size_t texel) { return (float(texel) + 0.5f) / float(side); }
  static bool is_wall(float x) { return x - std::floor(x) > low_x && x - std::floor(x) < high_x; }
  static float paint(float x, float y) {
    return 1 + 0.3f * std::cos(6.2831853f * x) + 0.2f * std::sin(6.2831853f * (2 * x + y));
  }

  // Where the ray through (x, 0) meets the walls or the ground.
  static float met_x(float x, float slope) {
    const float at_top = x + top * slope;
    if (is_wall(at_top) || slope == 0) return at_top;
    // Along x towards the ground; the ray comes from the side that the view is on.
    const float tile = std::floor(at_top);
    const float edge = slope > 0 ? (at_top - tile > high_x ? tile + high_x : tile - 1 + high_x)
                                 : (at_top - tile < low_x ? tile + low_x : tile + 1 + low_x);
    return slope > 0 ? std::max(x, edge) : std::min(x, edge);
  }

  static RawMaterial seen_from(std::vector<Vec3> views) {
    RawMaterial raw;
    raw.lights = {{0, 0, 1}};
    raw.views = std::move(views);
    raw.width = raw.height = side;
    for (std::size_t row = 0; row < 3; ++row)
      for (const Vec3 view : raw.views)
        for (std::size_t x = 0; x < side; ++x)
          for (std::size_t y = 0; y < side; ++y) {
            const float slope = view.x / view.z, at = met_x(middle(x), slope);
            // The share of the ray's way at which it meets them.
            const float z = std::abs(slope) > 1e-6f ? (at - middle(x)) / slope : is_wall(at) ? top : 0;
            raw.btf.push_back(paint(at, middle(y) + z * view.y / view.z));
          }
    return raw;
  }
};

}  // namespace

TEST_CASE("points of a relief that hides itself keep what stands before them, the others have their own") {
  RawMaterial raw = Walled::seen_from(spiral_directions(24));
  for (std::size_t t = 0; t < raw.texels(); ++t)
    raw.heights.push_back(Walled::is_wall(Walled::middle(t / Walled::side)) ? Walled::top : 0);
  // With 64 planes a view of 75 degrees moves by 0.84 texels from one to the next.
  const nook::material::Relief relief = relief_of_heights(raw, raw.heights, 64);
  std::vector<float> moved = raw.btf;
  move_to_relief(raw, relief, moved);
  // Sides of the wall lie between two texels of the heights.
  constexpr float near = 2.0f / float(Walled::side);
  std::size_t hidden = 0, shown = 0;
  double square = 0;
  for (std::size_t v = 0; v < raw.views.size(); ++v) {
    const float slope = raw.views[v].x / raw.views[v].z;
    for (std::size_t t = 0; t < raw.texels(); ++t) {
      const float x = Walled::middle(t / Walled::side), y = Walled::middle(t % Walled::side);
      if (std::abs(x - Walled::low_x) < near || std::abs(x - Walled::high_x) < near) continue;
      const std::size_t at = v * raw.texels() + t;
      INFO("x " << x << ", y " << y << ", slope " << slope);
      const auto sees = [&](float ground) { return Walled::met_x(ground, slope) == ground; };
      const int seen = sees(x - near) + sees(x) + sees(x + near);
      if (!Walled::is_wall(x) && seen == 0) {
        ++hidden;
        // The ray through a point of the ground crosses z = 0 there: the view's own texel shows the wall.
        CHECK(moved[at] == Approx(raw.btf[at]));
      } else if (Walled::is_wall(x) || seen == 3) {
        ++shown;
        // The colours of the sides, which are one texel wide, ring through the fit for some texels more.
        CHECK(moved[at] == Approx(Walled::paint(x, y)).margin(0.04));
        square += std::pow(double(moved[at]) - double(Walled::paint(x, y)), 2);
      }
    }
  }
  CHECK(hidden > raw.views.size() * raw.texels() / 10);
  CHECK(shown > raw.views.size() * raw.texels() / 2);
  // Two linear filters of waves of 24 and 48 texels leave up to 2 (2 pi / 24)^2 / 8 of 0.2, and less.
  CHECK(std::sqrt(square / double(shown)) < 0.004);
}

TEST_CASE("what does not move with the view, or has few views, gets no relief") {
  RawMaterial raw = test::small_material(4, 24);
  for (std::size_t i = 0; i < raw.btf.size(); ++i)
    raw.btf[i] = float(i % raw.texels() * 7 % 11);  // the same in every view
  CHECK_FALSE(estimate_relief(raw).moves());
  CHECK_FALSE(estimate_relief(Painted::seen_from(spiral_directions(7))).moves());
}

TEST_CASE("cancelled searches for a relief end with an error") {
  const RawMaterial raw = Painted::seen_from(spiral_directions(24));
  std::vector<std::size_t> steps;
  estimate_relief(raw, [&](std::size_t done, std::size_t total) {
    CHECK(total == 700);  // the heights, no relief, a plane and four smoothings
    steps.push_back(done);
    return true;
  });
  CHECK(std::is_sorted(steps.begin(), steps.end()));
  CHECK(steps.back() < 700);
  // Wherever it stands: the two blocks of 576 texels, the folds without a relief, the views on one.
  for (const std::size_t last : {0u, 1u, 4u, 6u}) {
    std::size_t calls = 0;
    CHECK_THROWS_AS(estimate_relief(raw, [&](std::size_t, std::size_t) { return calls++ < last; }), Failure);
    CHECK(calls == last + 1);
  }
}
