// Synthesis of planes against planted patterns: what comes out has the surroundings of the pattern.
#include "bakers/synthesis/synthesise.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "bakers/synthesis/seam_energy.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::bake::synthesis;

namespace {

// An exemplar of one channel.
template <class Value>
Exemplar exemplar_of(std::int32_t width, std::int32_t height, bool is_tiling, const Value& value) {
  Exemplar out;
  out.shape = {width, height, is_tiling};
  out.values.resize(out.shape.texels(), 1);
  for (std::int32_t y = 0; y < height; ++y)
    for (std::int32_t x = 0; x < width; ++x) out.values(out.shape.row({x, y}), 0) = value(x, y);
  return out;
}

Exemplar checker(std::int32_t side, std::int32_t square, bool is_tiling) {
  return exemplar_of(side, side, is_tiling,
                     [&](std::int32_t x, std::int32_t y) { return float((x / square + y / square) % 2); });
}

// Smooth noise: a sum of waves in random directions; some have periods that no crop repeats.
Exemplar waves(std::int32_t side, bool is_tiling, float periods) {
  material::test::Numbers numbers(3);
  std::array<std::array<float, 3>, 24> wave;
  for (auto& w : wave)
    w = {numbers.between(-periods, periods), numbers.between(-periods, periods), numbers.between(0, 6.28f)};
  return exemplar_of(side, side, is_tiling, [&](std::int32_t x, std::int32_t y) {
    float sum = 0;
    for (const auto& w : wave) {
      const float u = is_tiling ? std::round(w[0]) : w[0], v = is_tiling ? std::round(w[1]) : w[1];
      sum += std::sin(6.2831853f * (u * float(x) + v * float(y)) / float(side) + w[2]);
    }
    return sum / 5;
  });
}

// The shares of 3 x 3 windows of the plane that are windows of the exemplar.
double share_of_known_windows(const Exemplar& exemplar, const std::vector<Texel>& plane, std::int32_t side) {
  const ExemplarShape& s = exemplar.shape;
  const auto value = [&](Texel t) { return exemplar.values(s.row(s.inside(t)), 0) > 0.5f; };
  const auto window = [](const auto& at) {
    unsigned bits = 0;
    for (std::int32_t y = -1; y <= 1; ++y)
      for (std::int32_t x = -1; x <= 1; ++x) bits = 2 * bits + at(x, y);
    return bits;
  };
  std::set<unsigned> known;
  for (std::int32_t y = 1; y + 1 < s.height; ++y)
    for (std::int32_t x = 1; x + 1 < s.width; ++x)
      known.insert(window([&](std::int32_t i, std::int32_t j) { return value({x + i, y + j}); }));
  double found = 0;
  for (std::int32_t y = 0; y < side; ++y)
    for (std::int32_t x = 0; x < side; ++x)
      found += double(known.count(window([&](std::int32_t i, std::int32_t j) {
        return value(plane[std::size_t(wrapped(y + j, side) * side + wrapped(x + i, side))]);
      })));
  return found / (double(side) * side);
}

SynthesisSettings settings_of(std::uint32_t side) {
  SynthesisSettings settings;
  settings.side = side;
  return settings;
}

nook_result result_of(const Exemplar& exemplar, const SynthesisSettings& settings) {
  try {
    synthesise(exemplar, settings);
    return NOOK_OK;
  } catch (const Failure& failure) {
    return failure.code();
  }
}

}  // namespace

TEST_CASE("a checker comes back") {
  const bool is_tiling = GENERATE(true, false);
  const Exemplar exemplar = checker(40, 4, is_tiling);
  SynthesisSettings settings = settings_of(256);
  settings.jitter = 0;
  // Every window of the plane is one of the checker: the corrections join the blocks of one that does not
  // tile in its period of 8 texels, which divides the plane's 256.
  CHECK(share_of_known_windows(exemplar, synthesise(exemplar, settings), 256) == 1);
  // Blocks that were moved at random meet in another phase in places. Squares of 4 texels are as small as the
  // finest two levels, so that nothing coarser brings them into line.
  settings.jitter = 0.2f;
  CHECK(share_of_known_windows(exemplar, synthesise(exemplar, settings), 256) > 0.75);
}

TEST_CASE("stripes come back with their direction") {
  const Exemplar exemplar =
      exemplar_of(48, 48, true, [](std::int32_t x, std::int32_t y) { return float((x + y) / 6 % 2); });
  SynthesisSettings settings = settings_of(192);
  settings.jitter = 0.4f;
  // The stripes may meet with an offset in a few places.
  CHECK(share_of_known_windows(exemplar, synthesise(exemplar, settings), 192) > 0.95);
}

TEST_CASE("a crop that does not tile has less seam energy than its repetition") {
  const Exemplar exemplar = waves(64, false, 5.5f);
  const std::vector<Texel> plane = synthesise(exemplar, settings_of(256));
  const Seams before = measure_tiled(exemplar), after = measure_seams(exemplar, plane, 256);
  CHECK(before.jumps == Approx(1 / 64.0));
  CHECK(before.energy > 0);
  CHECK(after.energy < before.energy / 5);
}

TEST_CASE("a plane shows all parts of an exemplar and does not repeat with its period") {
  const Exemplar exemplar = waves(64, true, 5.5f);
  const std::vector<Texel> plane = synthesise(exemplar, settings_of(256));
  std::vector<int> shown(64 * 64, 0);
  double repeats = 0;
  for (std::int32_t y = 0; y < 256; ++y)
    for (std::int32_t x = 0; x < 256; ++x) {
      const Texel t = plane[std::size_t(y * 256 + x)];
      ++shown[std::size_t(t.y * 64 + t.x)];
      repeats += plane[std::size_t(y * 256 + (x + 64) % 256)] == t;
    }
  // A tiled plane would show each texel 16 times and repeat everywhere. Pieces that lie beside each other as
  // in the exemplar repeat, where two neighbours were moved alike.
  CHECK(double(std::count(shown.begin(), shown.end(), 0)) / 4096 < 0.4);
  CHECK(repeats / (256 * 256) < 0.2);
  // From afar the plane looks as the exemplar: the mean differs by less than a tenth of the deviation.
  double mean = 0;
  for (const Texel t : plane) mean += exemplar.values(exemplar.shape.row(t), 0);
  mean /= double(plane.size());
  const double own = double(exemplar.values.mean());
  const double deviation = std::sqrt(double((exemplar.values.array() - float(own)).square().mean()));
  CHECK(std::abs(mean - own) < 0.1 * deviation);
}

TEST_CASE("texels of an exemplar that does not tile keep off its border") {
  const Exemplar exemplar = waves(40, false, 4.3f);
  for (const Texel t : synthesise(exemplar, settings_of(128))) {
    CHECK((t.x >= 2 && t.x <= 37));
    CHECK((t.y >= 2 && t.y <= 37));
  }
}

TEST_CASE("the bits depend on the seed and not on the number of threads") {
  const Exemplar exemplar = waves(48, true, 4.5f);
  const auto with_threads = [&](int threads) {
    tbb::task_arena arena(threads);
    std::vector<Texel> plane;
    arena.execute([&] { plane = synthesise(exemplar, settings_of(128)); });
    return plane;
  };
  const std::vector<Texel> one = with_threads(1);
  CHECK(one == with_threads(3));
  SynthesisSettings other = settings_of(128);
  other.seed = 2;
  CHECK_FALSE(one == synthesise(exemplar, other));
}

TEST_CASE("a synthesis counts its work up and can be stopped") {
  const Exemplar exemplar = checker(32, 4, true);
  std::size_t last = 0, most = 0;
  synthesise(exemplar, settings_of(64), [&](std::size_t done, std::size_t total) {
    CHECK(done >= last);
    last = done;
    most = total;
    return true;
  });
  CHECK(last == most);
  try {
    synthesise(exemplar, settings_of(64),
               [](std::size_t done, std::size_t total) { return done < total / 2; });
    FAIL("it ran to the end");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_CANCELLED);
  }
}

TEST_CASE("bad input is refused") {
  const Exemplar good = checker(32, 4, true);
  SynthesisSettings settings = settings_of(64);
  CHECK(result_of(good, settings) == NOOK_OK);
  for (const std::uint32_t side : {0u, 63u, 100u, 8192u})
    CHECK(result_of(good, settings_of(side)) == NOOK_ERROR_INVALID_ARGUMENT);
  settings.jitter = std::numeric_limits<float>::quiet_NaN();
  CHECK(result_of(good, settings) == NOOK_ERROR_INVALID_ARGUMENT);
  settings = settings_of(64);
  settings.passes = 0;
  CHECK(result_of(good, settings) == NOOK_ERROR_INVALID_ARGUMENT);
  Exemplar bad = good;
  bad.values(5, 0) = std::numeric_limits<float>::infinity();
  CHECK(result_of(bad, settings_of(64)) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(result_of(checker(8, 4, true), settings_of(64)) == NOOK_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("a flat exemplar gives a plane") {
  const Exemplar flat = exemplar_of(32, 16, true, [](std::int32_t, std::int32_t) { return 0.5f; });
  CHECK(synthesise(flat, settings_of(64)).size() == 64 * 64);
}
