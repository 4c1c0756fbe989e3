#include "bakers/lab/nnao/row_statistics.h"

#include <cmath>

#include "bakers/raytrace/random.h"
#include "tests/catch.h"

using namespace nook::lab;
using namespace nook::measure;

namespace {

// Views with errors over three decades, whose ratio scatters around `ratio` by a factor of exp(spread).
std::vector<ErrorPair> planted(double ratio, double spread, std::size_t views, std::uint64_t seed,
                               const std::string& source) {
  nook::bake::Random random(seed);
  std::vector<ErrorPair> pairs;
  for (std::size_t i = 0; i < views; ++i) {
    const double reference = double(random.log_between(1e-4f, 1e-1f));
    pairs.push_back({source, reference * ratio * std::exp(spread * double(random.normal())), reference});
  }
  return pairs;
}

void append(std::vector<ErrorPair>& pairs, const std::vector<ErrorPair>& more) {
  pairs.insert(pairs.end(), more.begin(), more.end());
}

}  // namespace

TEST_CASE("a planted ratio is recovered exactly where it does not scatter") {
  const RatioStatistics statistics = compare_errors(planted(0.8, 0, 7, 1, "a"), 1);
  CHECK(std::abs(statistics.ratio - 0.8) < 1e-9);
  CHECK(std::abs(statistics.lower_95 - 0.8) < 1e-9);
  CHECK(std::abs(statistics.upper_95 - 0.8) < 1e-9);
  CHECK(statistics.views == 7);
}

TEST_CASE("sources have equal weights, however many views they have") {
  std::vector<ErrorPair> pairs = planted(0.5, 0, 20, 1, "large");
  append(pairs, planted(2.0, 0, 2, 2, "small"));
  const RatioStatistics statistics = compare_errors(pairs, 1);
  CHECK(std::abs(statistics.ratio - 1) < 1e-9);
  REQUIRE(statistics.sources.size() == 2);
  CHECK(statistics.sources[0].source == "large");
  CHECK(statistics.sources[0].views == 20);
  CHECK(std::abs(statistics.sources[0].ratio - 0.5) < 1e-9);
  CHECK(std::abs(statistics.sources[1].ratio - 2) < 1e-9);
  // Views within a source agree, so only the draw of the sources moves the mean.
  CHECK(std::abs(statistics.upper_95 - 1) < 1e-9);
  CHECK(std::abs(statistics.upper_95_sources - 2) < 1e-9);
}

TEST_CASE("the bounds of equal methods contain 1, about as often as they promise") {
  // Nine of ten intervals from 5 to 95 % contain the truth; small sources make them a little narrow.
  int contained = 0;
  for (std::uint64_t trial = 0; trial < 20; ++trial) {
    std::vector<ErrorPair> pairs;
    for (std::uint64_t s = 0; s < 6; ++s)
      append(pairs, planted(1, 0.2, 8, 100 * trial + s, "source " + std::to_string(s)));
    const RatioStatistics statistics = compare_errors(pairs, trial);
    CHECK(statistics.lower_95 < statistics.ratio);
    CHECK(statistics.upper_95 > statistics.ratio);
    contained += statistics.lower_95 <= 1 && statistics.upper_95 >= 1;
  }
  CHECK(contained >= 14);
}

TEST_CASE("the bounds are the same for the same seed, and near for another") {
  const std::vector<ErrorPair> pairs = planted(0.9, 0.3, 30, 5, "a");
  const RatioStatistics a = compare_errors(pairs, 1), b = compare_errors(pairs, 1),
                        c = compare_errors(pairs, 2);
  CHECK(a.upper_95 == b.upper_95);
  CHECK(a.upper_95_sources == b.upper_95_sources);
  CHECK(a.upper_95 != c.upper_95);
  CHECK(std::abs(a.upper_95 - c.upper_95) < 0.01);
  // The standard error of a mean of 30 is 0.3 / sqrt(30) = 0.055; the bound is 1.64 of them away.
  CHECK(std::abs(std::log(a.upper_95 / a.ratio) - 1.64 * 0.055) < 0.03);
}

TEST_CASE("errors of zero give a finite ratio") {
  const std::vector<ErrorPair> pairs{{"a", 0, 0}, {"a", 1e-3, 1e-3}};
  CHECK(std::abs(compare_errors(pairs, 1).ratio - 1) < 1e-9);
}
