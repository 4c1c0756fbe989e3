#include "samples/mannequin/skin_weights.h"

#include <algorithm>
#include <cmath>

#include "samples/mannequin/weight_seeds.h"

namespace nook_samples::mannequin {
namespace {

/// One weight for each vertex and bone, vertex by vertex.
using Table = std::vector<double>;

// One implicit diffusion step decays exponentially; a second one rounds its cusp into a smooth S.
constexpr int kSteps = 2;
constexpr int kSweeps = 50;
// Weaker influences are cut, so that the reach of a joint ends.
constexpr double kFaintest = 0.012;

Table seed_table(const std::vector<WeightSeed>& seeds, const Skeleton& skeleton) {
  Table table(seeds.size() * skeleton.size(), 0.0);
  for (std::size_t v = 0; v < seeds.size(); ++v) {
    for (const WeightSeed::Share& share : seeds[v].shares) {
      table[v * skeleton.size() + static_cast<std::size_t>(share.bone)] += share.weight;
    }
  }
  return table;
}

/// Solves (1 + spread² L) w = seeds by Gauss-Seidel sweeps, L being the graph Laplacian over squared edge
/// lengths.
Table spread(const Table& from, const TriangleMesh& mesh, const std::vector<WeightSeed>& seeds,
             std::size_t bones) {
  const auto neighbours = vertex_neighbours(mesh);
  Table table = from;
  std::vector<double> sum(bones);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t v = 0; v < neighbours.size(); ++v) {
      std::copy_n(&from[v * bones], bones, sum.begin());
      double total = 1.0;
      for (std::uint32_t n : neighbours[v]) {
        if (seeds[n].finger >= 0 && seeds[v].finger >= 0 && seeds[n].finger != seeds[v].finger) {
          continue;
        }
        const Vec3 edge = mesh.positions_m[n] - mesh.positions_m[v];
        const double reach = std::min(seeds[v].spread_m, seeds[n].spread_m);
        // In the plane a vertex has about six neighbours, and their mean differs by a quarter of L h².
        const double pull = 4.0 / static_cast<double>(neighbours[v].size()) * reach * reach /
                            glm::dot(edge, edge) / static_cast<double>(kSteps);
        total += pull;
        for (std::size_t b = 0; b < bones; ++b) {
          sum[b] += pull * table[n * bones + b];
        }
      }
      for (std::size_t b = 0; b < bones; ++b) {
        table[v * bones + b] = sum[b] / total;
      }
    }
  }
  return table;
}

VertexWeights strongest(const double* weights, std::size_t bones) {
  std::vector<std::uint16_t> order(bones);
  for (std::size_t b = 0; b < bones; ++b) {
    order[b] = static_cast<std::uint16_t>(b);
  }
  std::partial_sort(order.begin(), order.begin() + 4, order.end(), [&](std::uint16_t a, std::uint16_t b) {
    return weights[a] != weights[b] ? weights[a] > weights[b] : a < b;
  });
  // Subtracting the floor rather than testing against it lets influences fade in from zero.
  std::array<double, 4> kept{};
  double total = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    kept[k] = std::max(weights[order[k]] - kFaintest, 0.0);
    total += kept[k];
  }
  VertexWeights result;
  float rest = 1.0F;
  for (std::size_t k = 3; k > 0; --k) {
    result.weights[k] = static_cast<float>(kept[k] / total);
    result.bones[k] = result.weights[k] > 0.0F ? order[k] : std::uint16_t{0};
    rest -= result.weights[k];
  }
  result.weights[0] = rest;
  result.bones[0] = order[0];
  return result;
}

}  // namespace

std::vector<VertexWeights> make_skin_weights(const TriangleMesh& mesh, const Skeleton& skeleton) {
  std::vector<WeightSeed> seeds;
  for (const Vec3& p : mesh.positions_m) {
    seeds.push_back(seed_at(p, skeleton));
  }
  Table table = seed_table(seeds, skeleton);
  for (int step = 0; step < kSteps; ++step) {
    table = spread(table, mesh, seeds, skeleton.size());
  }
  std::vector<VertexWeights> result;
  for (std::size_t v = 0; v < mesh.positions_m.size(); ++v) {
    result.push_back(strongest(&table[v * skeleton.size()], skeleton.size()));
  }
  return result;
}

}  // namespace nook_samples::mannequin
