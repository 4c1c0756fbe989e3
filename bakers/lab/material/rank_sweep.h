// Errors over the total view rank, the paper's Figure 5, as rows and as line charts (SVG) for the documents.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/lab/material/material_peers.h"

namespace nook::lab {

// A line chart.
struct ChartLine {
  std::string label;
  std::vector<std::pair<double, double>> points;  // x, y
  bool dashed = false;
  int colour = -1;  // lines of one number share a colour; -1: the line's place
};

struct Chart {
  std::string title, x_label, y_label;
  bool logarithmic = false;  // y; values below 1 are drawn at 1
  std::vector<ChartLine> lines;
};

// Readable on light and dark pages. Charts without points give an empty frame.
std::string chart_svg(const Chart& chart);

struct Sweep {
  std::vector<std::uint32_t> ranks;
  struct Series {
    bake::material::Method method;
    std::uint32_t mixture;
    std::vector<bake::material::MethodRow>
        rows;  // one for each rank, fewer where clusters are fewer than the mixture
    std::vector<std::uint32_t> ranks;
  };
  std::vector<Series> series;  // N-SVD, CTA, K-CTA with K = 2, 3, 4
};

// Ranks are multiples of the cluster rank; throws Failure(INVALID_ARGUMENT) otherwise or where one does not
// fit.
Sweep measure_sweep(const bake::material::RawMaterial& raw,
                    const bake::material::CompressionSettings& settings, std::span<const std::uint32_t> ranks,
                    const measure::MethodProgress& progress);

// S/E, error texels of distances, and both forms of the VOTF by K-CTA with K = 3 and N-SVD.
std::vector<Chart> sweep_charts(const Sweep& sweep, const std::string& material);
nlohmann::ordered_json sweep_rows(const Sweep& sweep, const std::string& material);

// The first rank from which the distances of N-SVD have no more error texels than binary masks; 0: none.
std::uint32_t crossing_rank(const Sweep::Series& series);

}  // namespace nook::lab
