#include "bakers/probe/wall_fit.h"

#include <tbb/parallel_for.h>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bakers/raytrace/environment.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {
namespace {

using nook::probe::CellWalls;
using nook::probe::Probes;
using nook::probe::wall_planes;
using nook::probe::WallPlane;

constexpr std::size_t most_candidates = 24;
constexpr std::size_t least_places = 4;  // a side with fewer places gets no mask of its own
constexpr double plane_gain = 0.92;      // a plane must reduce the error to less than this share
// A mask must reduce the error by this share for each corner that it leaves out. With a smaller share,
// neighbouring cells would choose different masks, and you would see seams.
constexpr double corner_gain = 0.1;
constexpr double small_error = 2.5e-5;  // squared relative error of 0.5 %, too small for a wall
constexpr float dark_share = 0.1f;  // share of a cell's mean light; all darker places have the same weight
constexpr float same_normal = 0.999f, same_offset = 0.02f;  // cosine of the angle, and units of the spacing

// A training place, and the light that it would get from each corner's probe alone.
struct Sample {
  Vec3 in_cell;
  std::array<float, 8> weight;
  std::array<Vec3, 8> light;  // irradiance times the corner's weight
  Vec3 truth;
  bool on_surface;
  WallPlane tangent;  // the surface's tangent plane, moved a little behind the surface
  double importance;
};

struct Masked {
  double error;  // including a penalty for corners that are left out
  std::uint8_t mask;
};

double error_of(const std::vector<const Sample*>& samples, std::uint8_t mask) {
  double sum = 0;
  for (const Sample* s : samples) {
    Vec3 light;
    float weight = 0;
    for (std::size_t c = 0; c < 8; ++c)
      if (mask >> c & 1) {
        light += s->light[c];
        weight += s->weight[c];
      }
    const Vec3 off = light * (1 / weight) - s->truth;
    sum += s->importance * double(dot(off, off));
  }
  return sum;
}

Masked best_mask(const std::vector<const Sample*>& samples) {
  Masked best{error_of(samples, CellWalls::all_corners), CellWalls::all_corners};
  if (best.error < small_error * double(samples.size())) return best;
  for (unsigned mask = 254; mask > 0; --mask) {
    const int missing = 8 - __builtin_popcount(mask);
    const double error = error_of(samples, std::uint8_t(mask)) * (1 + corner_gain * missing);
    if (error < best.error) best = {error, std::uint8_t(mask)};
  }
  return best;
}

// A part of a cell, bounded by the planes that are chosen so far.
struct Side {
  std::size_t number = 0;
  std::vector<const Sample*> samples;
  Masked masked{};
};

bool is_behind(const WallPlane& plane, const Sample& sample) {
  return dot(plane.normal, sample.in_cell) + plane.offset < 0;
}

// Splits each side in two by a plane. A half with too few places gets the mask of the whole side.
std::vector<Side> split(const std::vector<Side>& sides, const WallPlane& plane, std::size_t k) {
  std::vector<Side> parts;
  for (const Side& side : sides) {
    Side half[2];
    for (const Sample* s : side.samples) half[is_behind(plane, *s)].samples.push_back(s);
    const bool whole = half[0].samples.empty() || half[1].samples.empty();
    for (std::size_t i = 0; i < 2; ++i) {
      half[i].number = side.number | i << k;
      if (whole)
        half[i].masked = {half[i].samples.empty() ? 0 : side.masked.error, side.masked.mask};
      else if (half[i].samples.size() < least_places)
        half[i].masked = {error_of(half[i].samples, side.masked.mask), side.masked.mask};
      else
        half[i].masked = best_mask(half[i].samples);
      parts.push_back(std::move(half[i]));
    }
  }
  return parts;
}

double total(const std::vector<Side>& sides) {
  double sum = 0;
  for (const Side& side : sides) sum += side.masked.error;
  return sum;
}

bool same_plane(const WallPlane& a, const WallPlane& b) {
  const float cosine = dot(a.normal, b.normal);
  return std::abs(cosine) > same_normal &&
         std::abs(a.offset - (cosine > 0 ? b.offset : -b.offset)) < same_offset;
}

// Returns the tangent planes of the cell's surfaces, the most frequent ones first.
std::vector<WallPlane> candidates_of(const std::vector<Sample>& samples) {
  struct Counted {
    WallPlane plane;
    std::size_t places;
  };
  std::vector<Counted> found;
  for (const Sample& s : samples) {
    if (!s.on_surface) continue;
    const auto same =
        std::ranges::find_if(found, [&](const Counted& other) { return same_plane(s.tangent, other.plane); });
    if (same == found.end())
      found.push_back({s.tangent, 1});
    else
      ++same->places;
  }
  std::ranges::stable_sort(found, [](const Counted& a, const Counted& b) { return a.places > b.places; });
  std::vector<WallPlane> planes;
  for (const Counted& counted : found)
    if (planes.size() < most_candidates) planes.push_back(counted.plane);
  return planes;
}

CellWalls fit_cell(const std::vector<Sample>& samples) {
  CellWalls walls;
  if (samples.empty()) return walls;
  std::vector<Side> sides(1);
  for (const Sample& s : samples) sides[0].samples.push_back(&s);
  sides[0].masked = best_mask(sides[0].samples);
  const std::vector<WallPlane> candidates = candidates_of(samples);
  for (std::size_t k = 0; k < wall_planes; ++k) {
    if (total(sides) < small_error * double(samples.size())) break;
    double least = plane_gain * total(sides);
    std::vector<Side> best;
    for (const WallPlane& plane : candidates) {
      std::vector<Side> parts = split(sides, plane, k);
      if (total(parts) >= least) continue;
      least = total(parts);
      best = std::move(parts);
      walls.plane[k] = plane;
    }
    if (best.empty()) break;
    sides = std::move(best);
  }
  // Nothing lies behind a missing plane, so look-ups never use the sides there.
  for (const Side& side : sides) walls.counts[side.number] = side.masked.mask;
  return walls;
}

Sample sample_of(const Probes& probes, const TrainingPlaces& places, std::size_t i, float bias,
                 std::size_t& cell) {
  Sample sample;
  const Vec3 normal = places.normal[i];
  const auto at = nook::probe::place_in(probes.grid, places.position_ws[i] + normal * bias);
  cell = at.cell;
  sample.in_cell = at.in_cell;
  sample.weight = nook::probe::corner_weights(at.in_cell, float(NOOK_GRID_LEAST_SHARE));
  for (std::size_t c = 0; c < 8; ++c)
    sample.light[c] = nook::probe::irradiance(probes.basis, probes.of(at.corner[c]),
                                              nook::probe::IrradianceForm::bands, normal) *
                      sample.weight[c];
  sample.truth = places.irradiance[i];
  sample.on_surface = places.on_surface[i] != 0;
  sample.importance = 1;
  // A plane lies behind its surface, at a quarter of the bias. So look-ups from this surface are in front of
  // the plane. Look-ups from the other face of a sheet are behind it, even if the sheet is thin.
  const Vec3 spacing = probes.grid.spacing_ws, across = by_channel(normal, spacing);
  const Vec3 unit = across * (1 / length(across));
  const Vec3 lift{normal.x * bias / spacing.x, normal.y * bias / spacing.y, normal.z * bias / spacing.z};
  sample.tangent = nook::probe::stored({unit, 1.25f * dot(unit, lift) - dot(unit, sample.in_cell)});
  return sample;
}

// Makes errors relative to the light at their place. So errors in a dark room count, even next to a bright
// room.
void weigh(std::vector<Sample>& samples) {
  double mean = 0;
  for (const Sample& s : samples) mean += double(luminance(s.truth)) / double(samples.size());
  const double floor = std::max(double(dark_share) * mean, 1e-30);
  for (Sample& s : samples) {
    const double light = double(luminance(s.truth)) + floor;
    s.importance = 1 / (light * light);
  }
}

}  // namespace

float wall_bias(const nook::probe::Grid& grid) {
  return 0.02f * std::min({grid.spacing_ws.x, grid.spacing_ws.y, grid.spacing_ws.z});
}

nook::probe::GridWalls fit_walls(const Probes& probes, const TrainingPlaces& places) {
  nook::probe::GridWalls walls;
  walls.bias = wall_bias(probes.grid);
  std::vector<std::vector<Sample>> samples(probes.grid.cells());
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::size_t cell = 0;
    const Sample sample = sample_of(probes, places, i, walls.bias, cell);
    samples[cell].push_back(sample);
  }
  walls.cell.resize(samples.size());
  tbb::parallel_for(std::size_t(0), samples.size(), [&](std::size_t cell) {
    weigh(samples[cell]);
    walls.cell[cell] = fit_cell(samples[cell]);
  });
  return walls;
}

namespace {

using nook::probe::Probes;
using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

constexpr std::uint32_t order = 2, functions = nook::probe::harmonic_count(order);
constexpr double least_light_share = 0.25;  // share of the mean light; all darker places have the same weight
constexpr double sealed_share = 1e-3;  // share of the mean light of all probes; darker probes are sealed off
constexpr int most_steps = 200;

// The weight of each corner's probe at a place, as in `interpolate`.
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

// Returns true for probes that no light reaches while others are lit. They keep their coefficients. A mask
// may let a dim place outside use such a probe. A fit to this place would also light the sealed-off room.
std::vector<bool> sealed_probes(const Probes& probes) {
  double mean = 0;
  for (std::size_t p = 0; p < probes.grid.size(); ++p)
    mean += double(luminance(probes.of(p)[0])) / double(probes.grid.size());
  std::vector<bool> sealed;
  for (std::size_t p = 0; p < probes.grid.size(); ++p)
    sealed.push_back(double(luminance(probes.of(p)[0])) < sealed_share * mean);
  return sealed;
}

}  // namespace

void fit_to_surfaces(Probes& probes, const TrainingPlaces& places, const SurfaceFitSettings& settings) {
  if (probes.basis.kind != nook::probe::BasisKind::harmonics || probes.basis.order != order)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "only spherical harmonics of order 2 can be fitted to surfaces (got a basis of %u functions)",
        probes.basis.count);
  const auto unknowns = Eigen::Index(probes.grid.size() * functions);
  const auto rows = Eigen::Index(places.size());
  double mean = 0;
  for (const Vec3 e : places.irradiance) mean += double(luminance(e)) / double(places.size());
  const std::vector<bool> sealed = sealed_probes(probes);
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd rest(rows + unknowns, 3);
  rest.setZero();
  for (Eigen::Index j = 0; j < rows; ++j) {
    const auto i = std::size_t(j);
    const Corners corners = corners_at(probes, places.position_ws[i], places.normal[i]);
    const std::array<double, functions> row = irradiance_row(places.normal[i]);
    const double importance = (1 + least_light_share) * mean /
                              (double(luminance(places.irradiance[i])) + least_light_share * mean + 1e-30);
    std::array<double, 3> found{};
    for (std::size_t c = 0; c < 8; ++c) {
      if (corners.weight[c] == 0) continue;
      for (std::uint32_t k = 0; k < functions; ++k) {
        const double factor = corners.weight[c] * row[k];
        const Vec3 b = probes.of(corners.probe[c])[k];
        found[0] += factor * double(b.x);
        found[1] += factor * double(b.y);
        found[2] += factor * double(b.z);
        if (!sealed[corners.probe[c]])
          entries.emplace_back(j, Eigen::Index(corners.probe[c] * functions + k), importance * factor);
      }
    }
    const Vec3 truth = places.irradiance[i];
    channel(rest, j, 0) = importance * (double(truth.x) - found[0]);
    channel(rest, j, 1) = importance * (double(truth.y) - found[1]);
    channel(rest, j, 2) = importance * (double(truth.z) - found[2]);
  }
  // These rows keep the coefficients close to the baked ones. The change of each coefficient is weighted by
  // how much its band affects irradiance.
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
