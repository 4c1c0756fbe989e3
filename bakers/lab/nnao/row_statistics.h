// Statistics for report rows over several sources: ratios of errors with confidence bounds, means that skip
// missing values, and numbers formatted for tables.
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
  std::string source;  // source of the scene; views of the same source resemble each other
  double error = 0, reference = 0;
};

struct SourceRatio {
  std::string source;
  std::size_t views = 0;
  double ratio = 0;  // geometric mean over the views of the source
};

// The ratio of two methods' errors over many views, as a geometric mean with bootstrap bounds.
struct RatioStatistics {
  // The geometric mean of the ratios of the sources. All sources have the same weight, independent of their
  // number of views.
  double ratio = 1;
  // The 5 % and 95 % quantiles of this mean when the views within each source are resampled.
  double lower_95 = 1, upper_95 = 1;
  // The 95 % quantile of this mean when the sources are resampled as well. Use it as the bound if you want to
  // draw conclusions about other scenes.
  double upper_95_sources = 1;
  std::size_t views = 0;
  std::vector<SourceRatio> sources;  // in the order of their first views
};

inline constexpr std::size_t bootstrap_draws = 10000;

// The bootstrap always draws the two errors of a pair together. The result depends only on the pairs and the
// seed. `pairs` must not be empty. Errors below 1e-9 count as 1e-9, which is far below the square of one grey
// level.
RatioStatistics compare_errors(std::span<const ErrorPair> pairs, std::uint64_t seed);

// Returns the distinct names of the items, in the order of their first occurrence.
template <typename Item>
std::vector<std::string> distinct_names(std::span<const Item> items, std::string Item::*name) {
  std::vector<std::string> names;
  for (const Item& item : items)
    if (std::ranges::find(names, item.*name) == names.end()) names.push_back(item.*name);
  return names;
}

// Returns null if no value was added.
nlohmann::ordered_json mean_or_null(const measure::Mean& mean);

// Returns the mean of each column, over the rows that have a number in that column. Other members are copied
// from the first row. `rows` must not be empty, and each row must have all columns.
nlohmann::ordered_json mean_row(std::span<const nlohmann::ordered_json> rows,
                                std::span<const std::string> columns);

// Formats a member with a printf format for a double. Returns "-" if the member is not a number.
std::string table_number(const nlohmann::ordered_json& row, const char* key, const char* format);

}  // namespace nook::lab
