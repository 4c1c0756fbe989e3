#include "bakers/probe/wall_fit.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/probe_light.h"

namespace nook::bake::probe {
namespace {

using nook::probe::CellWalls;
using nook::probe::Probes;
using nook::probe::wall_planes;
using nook::probe::WallPlane;

constexpr std::size_t most_candidates = 24;
constexpr std::size_t least_places = 4;  // on a side that has a mask of its own
constexpr double plane_gain = 0.92;      // a plane must bring the error below this share of what it was
// A mask must bring the error down by this share for each corner that it leaves out; with less, neighbouring
// cells choose differently, and seams show between them.
constexpr double corner_gain = 0.1;
constexpr double small_error = 2.5e-5;  // mean square of relative errors, 0.5 %, which no wall explains
constexpr float dark_share = 0.1f;      // of a cell's mean light, below which errors count alike
constexpr float same_normal = 0.999f, same_offset = 0.02f;  // cosine, and spacings

// A place, and what each corner's probe alone would give there.
struct Sample {
  Vec3 in_cell;
  std::array<float, 8> weight;
  std::array<Vec3, 8> light;  // irradiance times that weight
  Vec3 truth;
  bool on_surface;
  WallPlane tangent;  // of the surface, a little behind it
  double importance;
};

struct Masked {
  double error;  // with the price of its missing corners
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

// A part of a cell between the planes so far.
struct Side {
  std::size_t number = 0;
  std::vector<const Sample*> samples;
  Masked masked{};
};

bool is_behind(const WallPlane& plane, const Sample& sample) {
  return dot(plane.normal, sample.in_cell) + plane.offset < 0;
}

// Both halves of each side; where one has too few places, it takes the mask of the whole.
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

// The tangent planes of the cell's surfaces, the most frequent ones first.
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
  // Sides behind planes that are not there have no places, and are never looked up.
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
  // Planes pass the surface itself by a quarter of the bias, so that places at its foot are in front of them,
  // and places on the other face of the thinnest sheet behind them.
  const Vec3 spacing = probes.grid.spacing_ws, across = by_channel(normal, spacing);
  const Vec3 unit = across * (1 / length(across));
  const Vec3 lift{normal.x * bias / spacing.x, normal.y * bias / spacing.y, normal.z * bias / spacing.z};
  sample.tangent = nook::probe::stored({unit, 1.25f * dot(unit, lift) - dot(unit, sample.in_cell)});
  return sample;
}

// Errors count relative to the light of their place, so that those of dark rooms beside bright ones do.
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

}  // namespace nook::bake::probe
