// Rows of reports over several sources: ratios of errors with their bounds, means that leave out what a
// source lacks, and numbers of tables.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <ranges>
#include <span>
#include <string>
#include <vector>

#include "bakers/measure/nnao/image_error.h"

namespace nook::lab {

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

// The ratio of two methods' errors over many views: a geometric mean with a bootstrap's bounds.
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

// The names of all items, each once, in the order of their first items.
template <typename Item>
std::vector<std::string> distinct_names(std::span<const Item> items, std::string Item::*name) {
  std::vector<std::string> names;
  for (const Item& item : items)
    if (std::ranges::find(names, item.*name) == names.end()) names.push_back(item.*name);
  return names;
}

// null before the first value.
nlohmann::ordered_json mean_or_null(const measure::Mean& mean);

// The mean of each column over the rows in which it is no null; other members are those of the first row.
// rows: one or more, with all columns.
nlohmann::ordered_json mean_row(std::span<const nlohmann::ordered_json> rows,
                                std::span<const std::string> columns);

// A member by a format of printf for a double; "-" without a number.
std::string table_number(const nlohmann::ordered_json& row, const char* key, const char* format);

}  // namespace nook::lab
