// Measures errors as a function of the total view rank, as in the paper's Figure 5. Makes rows and line
// charts (SVG) for the documents.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/lab/material/material_peers.h"

namespace nook::lab {

struct ChartLine {
  std::string label;
  std::vector<std::pair<double, double>> points;  // x, y
  bool dashed = false;
  int colour = -1;  // index of the colour; -1: the index of the line
};

struct Chart {
  std::string title, x_label, y_label;
  bool logarithmic = false;  // y axis; values below 1 are drawn at 1
  std::vector<ChartLine> lines;
};

// Returns the chart as SVG that is readable on light and dark pages. If there are no points, the chart is an
// empty frame.
std::string chart_svg(const Chart& chart);

struct Sweep {
  std::vector<std::uint32_t> ranks;
  struct Series {
    bake::material::Method method;
    std::uint32_t mixture;
    // One row per rank; ranks that give fewer clusters than the mixture needs are left out.
    std::vector<bake::material::MethodRow> rows;
    std::vector<std::uint32_t> ranks;
  };
  std::vector<Series> series;  // N-SVD, CTA, K-CTA with K = 2, 3, 4
};

// Measures all series at the given ranks. The ranks must be multiples of the cluster rank. Throws
// Failure(INVALID_ARGUMENT) otherwise, or if a rank is too large.
Sweep measure_sweep(const bake::material::RawMaterial& raw,
                    const bake::material::CompressionSettings& settings, std::span<const std::uint32_t> ranks,
                    const measure::MethodProgress& progress);

// Returns three charts. They show the signal-to-error ratio (S/E), the error texels of VOTFs in the distance
// form, and both VOTF forms for N-SVD and for K-CTA with K = 3.
std::vector<Chart> sweep_charts(const Sweep& sweep, const std::string& material);
nlohmann::ordered_json sweep_rows(const Sweep& sweep, const std::string& material);

// Returns the smallest rank from which on N-SVD of distances has at most as many error texels as N-SVD of
// binary masks. Returns 0 if there is no such rank.
std::uint32_t crossing_rank(const Sweep::Series& series);

}  // namespace nook::lab
