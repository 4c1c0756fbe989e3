// Errors over the total view rank: the paper's Figure 5.
#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "bakers/measure/material/chart.h"
#include "bakers/measure/material/comparison.h"

namespace nook::measure {

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

// Returns the progress of one method, whose name it is given.
using MethodProgress = std::function<bake::material::StageProgress(const std::string& method)>;

// Ranks are multiples of the cluster rank; throws Failure(INVALID_ARGUMENT) otherwise or where one does not
// fit.
Sweep measure_sweep(const bake::material::RawMaterial& raw,
                    const bake::material::CompressionSettings& settings, std::span<const std::uint32_t> ranks,
                    const MethodProgress& progress);

// S/E, error texels of distances, and both forms of the VOTF by K-CTA with K = 3 and N-SVD.
std::vector<Chart> sweep_charts(const Sweep& sweep, const std::string& material);
nlohmann::ordered_json sweep_rows(const Sweep& sweep, const std::string& material);

// The first rank from which the distances of N-SVD have no more error texels than binary masks; 0: none.
std::uint32_t crossing_rank(const Sweep::Series& series);

}  // namespace nook::measure
