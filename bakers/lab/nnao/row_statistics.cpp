#include "bakers/lab/nnao/row_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bakers/raytrace/random.h"

namespace nook::lab {

using namespace measure;
using Json = nlohmann::ordered_json;

namespace {

constexpr double smallest_error = 1e-9;

// The logarithms of the ratios, for the views of one source.
struct Source {
  std::string name;
  std::vector<double> log_ratio;
};

std::vector<Source> by_source(std::span<const ErrorPair> pairs) {
  std::vector<Source> sources;
  for (const ErrorPair& pair : pairs) {
    auto source = std::ranges::find(sources, pair.source, &Source::name);
    if (source == sources.end()) source = sources.insert(source, {pair.source, {}});
    source->log_ratio.push_back(
        std::log(std::max(pair.error, smallest_error) / std::max(pair.reference, smallest_error)));
  }
  return sources;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / double(values.size());
}

double drawn_mean(const std::vector<double>& values, bake::Random& random) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[random.below(std::uint32_t(values.size()))];
  return sum / double(values.size());
}

// Resamples the views `draws` times. Returns the mean over the sources for each draw, sorted. If
// `sources_too` is true, also resamples the sources.
std::vector<double> drawn_means(const std::vector<Source>& sources, bool sources_too, std::uint64_t seed) {
  bake::Random random(seed);
  std::vector<double> means(bootstrap_draws);
  for (double& value : means) {
    value = 0;
    for (std::size_t s = 0; s < sources.size(); ++s) {
      const std::size_t drawn = sources_too ? random.below(std::uint32_t(sources.size())) : s;
      value += drawn_mean(sources[drawn].log_ratio, random) / double(sources.size());
    }
  }
  std::ranges::sort(means);
  return means;
}

double quantile(const std::vector<double>& sorted, double share) {
  return sorted[std::size_t(share * double(sorted.size() - 1) + 0.5)];
}

}  // namespace

RatioStatistics compare_errors(std::span<const ErrorPair> pairs, std::uint64_t seed) {
  const std::vector<Source> sources = by_source(pairs);
  RatioStatistics statistics;
  statistics.views = pairs.size();
  std::vector<double> means;
  for (const Source& source : sources) {
    means.push_back(mean(source.log_ratio));
    statistics.sources.push_back({source.name, source.log_ratio.size(), std::exp(means.back())});
  }
  statistics.ratio = std::exp(mean(means));
  const std::vector<double> drawn = drawn_means(sources, false, seed);
  statistics.lower_95 = std::exp(quantile(drawn, 0.05));
  statistics.upper_95 = std::exp(quantile(drawn, 0.95));
  statistics.upper_95_sources = std::exp(quantile(drawn_means(sources, true, seed), 0.95));
  return statistics;
}

Json mean_or_null(const Mean& mean) {
  return mean.count > 0 ? Json(mean.value()) : Json();
}

Json mean_row(std::span<const Json> rows, std::span<const std::string> columns) {
  Json row = rows.front();
  for (const std::string& column : columns) {
    Mean mean;
    for (const Json& of_source : rows)
      if (!of_source[column].is_null()) mean.add(of_source[column].get<double>());
    row[column] = mean_or_null(mean);
  }
  return row;
}

std::string table_number(const Json& row, const char* key, const char* format) {
  if (!row.contains(key) || !row[key].is_number()) return "-";
  char text[32];
  std::snprintf(text, sizeof text, format, row[key].get<double>());
  return text;
}

}  // namespace nook::lab
