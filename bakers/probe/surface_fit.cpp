#include "bakers/probe/surface_fit.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/raytrace/environment.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::bake::probe {
namespace {

using nook::probe::Probes;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr std::uint32_t order = 2, functions = nook::probe::harmonic_count(order);
constexpr double dark_share = 0.25;  // of the mean light, below which errors count alike
constexpr int most_steps = 200;

// The weight of each corner's probe at a place, as interpolate has it.
struct Corners {
  std::array<std::size_t, 8> probe;
  std::array<double, 8> weight{};
};
Corners corners_at(const Probes& probes, Vec3 position_ws, Vec3 normal) {
  const bool any = probes.walls.any();
  const auto place =
      nook::probe::place_in(probes.grid, any ? position_ws + normal * probes.walls.bias : position_ws);
  std::uint8_t mask = nook::probe::CellWalls::all_corners;
  if (any) {
    const nook::probe::CellWalls& walls = probes.walls.cell[place.cell];
    mask = walls.counts[nook::probe::side_of(walls, place.in_cell)];
  }
  const bool open = mask == nook::probe::CellWalls::all_corners;
  const auto weight = nook::probe::corner_weights(place.in_cell, open ? 0.0f : float(NOOK_GRID_LEAST_SHARE));
  Corners corners{place.corner, {}};
  double sum = 0;
  for (std::size_t c = 0; c < 8; ++c)
    if (mask >> c & 1) sum += double(weight[c]);
  for (std::size_t c = 0; c < 8; ++c)
    if (mask >> c & 1) corners.weight[c] = double(weight[c]) / sum;
  return corners;
}

std::array<double, functions> irradiance_row(Vec3 normal) {
  std::array<double, functions> row;
  nook::probe::evaluate_harmonics(order, double(normal.x), double(normal.y), double(normal.z), row.data());
  for (std::uint32_t l = 0, i = 0; l <= order; ++l)
    for (; i < nook::probe::harmonic_count(l); ++i) row[i] *= nook::probe::cosine_band[l];
  return row;
}

double& channel(Eigen::MatrixXd& m, Eigen::Index row, int c) {
  return m(row, c);
}

}  // namespace

void fit_to_surfaces(Probes& probes, const TrainingPlaces& places, const SurfaceFitSettings& settings) {
  if (probes.basis.kind != nook::probe::BasisKind::harmonics || probes.basis.order != order)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "only harmonics of order 2 can be fitted to surfaces (got %u functions)",
                  probes.basis.count);
  const auto unknowns = Eigen::Index(probes.grid.size() * functions);
  const auto rows = Eigen::Index(places.size());
  double mean = 0;
  for (const Vec3 e : places.irradiance) mean += double(luminance(e)) / double(places.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd rest(rows + unknowns, 3);
  rest.setZero();
  for (Eigen::Index j = 0; j < rows; ++j) {
    const auto i = std::size_t(j);
    const Corners corners = corners_at(probes, places.position_ws[i], places.normal[i]);
    const std::array<double, functions> row = irradiance_row(places.normal[i]);
    const double importance =
        (1 + dark_share) * mean / (double(luminance(places.irradiance[i])) + dark_share * mean + 1e-30);
    std::array<double, 3> found{};
    for (std::size_t c = 0; c < 8; ++c) {
      if (corners.weight[c] == 0) continue;
      for (std::uint32_t k = 0; k < functions; ++k) {
        const double factor = corners.weight[c] * row[k];
        const Vec3 b = probes.of(corners.probe[c])[k];
        found[0] += factor * double(b.x);
        found[1] += factor * double(b.y);
        found[2] += factor * double(b.z);
        entries.emplace_back(j, Eigen::Index(corners.probe[c] * functions + k), importance * factor);
      }
    }
    const Vec3 truth = places.irradiance[i];
    channel(rest, j, 0) = importance * (double(truth.x) - found[0]);
    channel(rest, j, 1) = importance * (double(truth.y) - found[1]);
    channel(rest, j, 2) = importance * (double(truth.z) - found[2]);
  }
  // Differences of each band count as much as they change irradiance.
  for (Eigen::Index u = 0; u < unknowns; ++u) {
    const auto k = std::uint32_t(u % functions);
    const std::size_t band = k == 0 ? 0 : k < 4 ? 1 : 2;
    entries.emplace_back(rows + u, u,
                         std::sqrt(settings.own_share / (4 * M_PI)) * nook::probe::cosine_band[band]);
  }
  Sparse matrix(rows + unknowns, unknowns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::LeastSquaresConjugateGradient<Sparse> solver;
  solver.setMaxIterations(most_steps);
  solver.setTolerance(1e-6);
  solver.compute(matrix);
  const Eigen::MatrixXd change = solver.solve(rest);
  for (Eigen::Index u = 0; u < unknowns; ++u)
    probes.coefficients[std::size_t(u)] +=
        Vec3{float(change(u, 0)), float(change(u, 1)), float(change(u, 2))};
}

}  // namespace nook::bake::probe
