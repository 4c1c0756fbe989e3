// Measures errors over the total view rank, like the paper's Figure 5. Makes rows and line charts (SVG) for
// the documents.
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
  int colour = -1;  // lines with the same number share a colour; -1: the line's place
};

struct Chart {
  std::string title, x_label, y_label;
  bool logarithmic = false;  // y axis; values below 1 are drawn at 1
  std::vector<ChartLine> lines;
};

// The chart is readable on light and dark pages. A chart without points is an empty frame.
std::string chart_svg(const Chart& chart);

struct Sweep {
  std::vector<std::uint32_t> ranks;
  struct Series {
    bake::material::Method method;
    std::uint32_t mixture;
    std::vector<bake::material::MethodRow>
        rows;  // one for each rank; fewer if clusters are fewer than the mixture
    std::vector<std::uint32_t> ranks;
  };
  std::vector<Series> series;  // N-SVD, CTA, K-CTA with K = 2, 3, 4
};

// Ranks must be multiples of the cluster rank. Throws Failure(INVALID_ARGUMENT) otherwise, or if one does not
// fit.
Sweep measure_sweep(const bake::material::RawMaterial& raw,
                    const bake::material::CompressionSettings& settings, std::span<const std::uint32_t> ranks,
                    const measure::MethodProgress& progress);

// Draws S/E, error texels of distances, and both forms of the VOTF by K-CTA with K = 3 and N-SVD.
std::vector<Chart> sweep_charts(const Sweep& sweep, const std::string& material);
nlohmann::ordered_json sweep_rows(const Sweep& sweep, const std::string& material);

// Returns the first rank from which N-SVD with distances has no more error texels than with binary masks; 0:
// none.
std::uint32_t crossing_rank(const Sweep::Series& series);

}  // namespace nook::lab
