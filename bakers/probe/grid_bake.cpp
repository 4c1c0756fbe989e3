#include "bakers/probe/grid_bake.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "bakers/probe/inside_probes.h"
#include "bakers/probe/map_bake.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::probe {
namespace {

double square_of(std::span<const double> gram, std::span<const Vec3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) sum += gram[i * b.size() + k] * double(dot(b[i], b[k]));
  return sum;
}

}  // namespace

GridBake::GridBake(const LitScene& scene, const GridBakeSettings& settings)
    : scene_(scene),
      settings_(settings),
      light_(scene.environment(), uniform_share),
      gram_(nook::probe::basis_gram(settings.basis)) {
  if (settings.grid.size() == 0 || settings.grid.size() > nook::probe::max_probes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "the grid has %zu probes (need 1 to %u)", settings.grid.size(),
                  nook::probe::max_probes);
  nook::probe::check_grid(settings.grid, NOOK_ERROR_INVALID_ARGUMENT);
  for (std::size_t i = 0; i < settings.grid.size(); ++i) fits_.emplace_back(settings);
  positions_ws_ = settings.move_probes ? moved_probes(scene, settings.grid) : grid_probes(settings.grid);
  inside_ = inside_probes(scene, positions_ws_);
}

void GridBake::pass() {
  const Region region = region_of(settings_.basis);
  tbb::parallel_for(std::size_t(0), fits_.size(), [&](std::size_t p) {
    if (inside_[p]) return;
    const FlushDenormals flush;
    const Vec3 origin = positions_ws_[p];
    Samples traced;
    for (std::uint32_t s = 0; s < settings_.samples_per_pass; ++s) {
      Random random(mix_bits(settings_.seed ^ mix_bits(p)) + mix_bits(samples() + s));
      const double choice = random.unit_double();
      const float alias = random.unit(), u = random.unit(), v = random.unit();
      const LightSample light = light_.sample(choice, alias, u, v);
      if (!region.holds(light.direction)) continue;
      traced.add(light.direction, trace_radiance(scene_, origin, light.direction, settings_.path, random),
                 float(1 / (nook::probe::domain_area(region.domain) * double(light.density))));
    }
    if (traced.size() == 0) return;
    add_samples(fits_[p].all, traced, 0, traced.size());
    add_samples(passes_ % 2 ? fits_[p].even : fits_[p].odd, traced, 0, traced.size());
  });
  ++passes_;
}

double GridBake::error() {
  if (passes_ < 2) return 1;
  const std::size_t count = settings_.basis.count;
  std::vector<double> apart(fits_.size()), size(fits_.size());
  tbb::parallel_for(std::size_t(0), fits_.size(), [&](std::size_t p) {
    std::vector<Vec3> all(count), odd(count), even(count);
    fits_[p].all.read(all);
    fits_[p].odd.read(odd);
    fits_[p].even.read(even);
    for (std::size_t i = 0; i < count; ++i) odd[i] = odd[i] - even[i];
    apart[p] = square_of(gram_, odd);
    size[p] = square_of(gram_, all);
  });
  double apart_sum = 0, size_sum = 0;
  for (std::size_t p = 0; p < fits_.size(); ++p) {
    apart_sum += apart[p];
    size_sum += size[p];
  }
  // Each half has twice the variance of the whole fit, so the difference of the halves has four times that
  // variance.
  return size_sum > 0 ? 0.5 * std::sqrt(std::max(apart_sum, 0.0) / size_sum) : 0.0;
}

nook::probe::Probes GridBake::probes() {
  nook::probe::Probes probes;
  probes.basis = settings_.basis;
  probes.grid = settings_.grid;
  probes.coefficients.resize(fits_.size() * settings_.basis.count);
  for (std::size_t p = 0; p < fits_.size(); ++p)
    fits_[p].all.read(
        std::span(probes.coefficients).subspan(p * settings_.basis.count, settings_.basis.count));
  if (settings_.basis.kind == nook::probe::BasisKind::gaussians) {
    probes.gloss.resize(probes.coefficients.size());
    for (std::size_t p = 0; p < fits_.size(); ++p)
      fits_[p].all.read_gloss(
          std::span(probes.gloss).subspan(p * settings_.basis.count, settings_.basis.count));
  }
  fill_inside(probes, inside_);
  return probes;
}

nook::probe::Grid grid_in_box(const std::array<std::uint32_t, 3>& counts, Vec3 low_ws, Vec3 high_ws) {
  constexpr float least_spacing = 1e-3f;  // metres, for flat boxes
  const auto spacing = [=](float low, float high, std::uint32_t count) {
    return std::max((high - low) / float(count), least_spacing);
  };
  nook::probe::Grid grid;
  grid.counts = counts;
  grid.spacing_ws = {spacing(low_ws.x, high_ws.x, counts[0]), spacing(low_ws.y, high_ws.y, counts[1]),
                     spacing(low_ws.z, high_ws.z, counts[2])};
  grid.origin_ws = low_ws + 0.5f * grid.spacing_ws;
  return grid;
}

}  // namespace nook::bake::probe
