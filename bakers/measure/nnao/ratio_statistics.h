// The ratio of two methods' errors over many views: a geometric mean with a bootstrap's bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nook::measure {

// The errors of two methods in one view.
struct ErrorPair {
  std::string source;  // of the scene: views of one source resemble each other
  double error = 0, reference = 0;
};

struct SourceRatio {
  std::string source;
  std::size_t views = 0;
  double ratio = 0;  // geometric mean over its views
};

struct RatioStatistics {
  // The geometric mean of the sources' ratios. Sources have equal weights, however many views they have.
  double ratio = 1;
  // Quantiles of 5 % and 95 % of that mean where the views within each source are drawn anew.
  double lower_95 = 1, upper_95 = 1;
  // The upper one where the sources are drawn anew as well: that of other scenes than these.
  double upper_95_sources = 1;
  std::size_t views = 0;
  std::vector<SourceRatio> sources;  // in the order of their first views
};

inline constexpr std::size_t bootstrap_draws = 10000;

// A pair's two errors are always drawn together. The result depends on the pairs and the seed alone. pairs:
// one or more. Errors below 1e-9, far below a grey level squared, count as 1e-9.
RatioStatistics compare_errors(std::span<const ErrorPair> pairs, std::uint64_t seed);

}  // namespace nook::measure
