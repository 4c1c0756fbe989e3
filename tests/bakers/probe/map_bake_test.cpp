// Probes of maps: what is in the basis comes back, and every kind of sampling agrees.
#include "bakers/probe/map_bake.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

#include "bakers/measure/probe/fit_error.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::probe;
using namespace nook::test;
using nook::probe::FitMethod;

namespace {

MapBakeSettings settings_of(const Basis& basis, FitMethod method, Sampling sampling = Sampling::automatic) {
  MapBakeSettings settings;
  settings.basis = basis;
  settings.fit.method = method;
  settings.fit.constraint = nook::probe::Constraint::none;
  settings.sampling = sampling;
  settings.samples = 1u << 17;
  return settings;
}

}  // namespace

TEST_CASE("a map that lies in the basis comes back") {
  const Basis basis = nook::probe::vogel_basis(12);
  std::vector<Vec3> planted(12);
  for (std::size_t i = 0; i < 12; ++i) planted[i] = {1 + 0.2f * float(i), 3 - 0.2f * float(i), 0.5f};
  const Environment map = map_of(256, 128, [&](Vec3 d) { return nook::probe::radiance(basis, planted, d); });
  for (FitMethod method :
       {FitMethod::least_squares, FitMethod::moments, FitMethod::non_negative_least_squares,
        FitMethod::running_average, FitMethod::running_average_non_negative})
    for (Sampling sampling : {Sampling::texels, Sampling::luminance}) {
      const std::vector<Vec3> b = bake_map(map, settings_of(basis, method, sampling));
      const ExactFit exact(map, basis);
      // Texels of 1.4 degrees are constant, which alone leaves 1e-5; moments from 131,072 samples scatter by
      // 1e-4 in square.
      CHECK(exact.distance(b) < 5e-4);
    }
}

TEST_CASE("every kind of sampling tends to the exact fit") {
  const Environment map = uneven_map();
  const Basis basis = nook::probe::vogel_basis(9, true);
  const ExactFit exact(map, basis);
  CHECK(exact.excess(bake_map(map, settings_of(basis, FitMethod::least_squares))) <
        1e-4);  // texels' centres alone
  // 131,072 samples, 10 unknowns: 1e-4 of the residual's variance, more where light is uneven.
  CHECK(exact.excess(bake_map(map, settings_of(basis, FitMethod::least_squares, Sampling::uniform))) < 2e-3);
  CHECK(exact.excess(bake_map(map, settings_of(basis, FitMethod::least_squares, Sampling::luminance))) <
        2e-3);
  CHECK(exact.excess(bake_map(map, settings_of(basis, FitMethod::running_average))) < 4e-3);
  const Basis half = nook::probe::vogel_basis(6, false, Domain::hemisphere, {0, 1, 0});
  const ExactFit upper(map, half);
  CHECK(upper.excess(bake_map(map, settings_of(half, FitMethod::least_squares))) < 1e-4);
  CHECK(upper.excess(bake_map(map, settings_of(half, FitMethod::least_squares, Sampling::uniform))) < 2e-3);
  CHECK(upper.excess(bake_map(map, settings_of(half, FitMethod::least_squares, Sampling::luminance))) < 2e-3);
}

TEST_CASE("samples are weighted by the density that drew them") {
  const Environment map = uneven_map();
  for (Domain domain : {Domain::sphere, Domain::hemisphere}) {
    const Region region{domain, {0, 1, 0}};
    const MapIntegrals truth = integrate(map, region);
    const double area = nook::probe::domain_area(domain);
    const LightSampler sampler(map, uniform_share);
    for (const Samples& samples : {uniform_samples(map, region, 200000, 3), texel_samples(map, region, 3),
                                   luminance_samples(map, sampler, region, 200000, 3)}) {
      double weight = 0, light = 0;
      float heaviest = 0;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        weight += double(samples.weight[i]);
        light += double(samples.weight[i]) * double(samples.radiance[3 * i]);
        heaviest = std::max(heaviest, samples.weight[i]);
      }
      // Half of the directions are uniform; above the horizon lies a little more than half of the light.
      CHECK(heaviest < (domain == Domain::sphere ? 2.01f : 2.4f));
      // The lamp fills a hundredth of the sphere and gives half of the light: 2.5 % for 200,000 uniform
      // samples is four sigma.
      CHECK(std::abs(weight / double(samples.size()) - 1) < 0.01);
      CHECK(std::abs(light / double(samples.size()) * area / truth.radiance[0] - 1) < 0.025);
    }
  }
}

TEST_CASE("a bake is the same on any number of threads and can be cancelled") {
  const Environment map = uneven_map();
  const MapBakeSettings settings = settings_of(nook::probe::vogel_basis(12), FitMethod::running_average);
  std::vector<Vec3> one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = bake_map(map, settings);
  }
  CHECK(one == bake_map(map, settings));
  CHECK_THROWS_AS(bake_map(map, settings, [](std::size_t, std::size_t) { return false; }), Failure);
}

TEST_CASE("gloss of a map leaves its suns out and is above 0 wherever there is light") {
  const Basis basis = nook::probe::vogel_basis(12);
  const auto sky = [](Vec3 d) { return Vec3{1 + 0.5f * d.x, 1, 1 - 0.5f * d.z}; };
  const Environment plain = map_of(128, 64, sky);
  const Environment sunny = map_of(128, 64, [&](Vec3 d) {
    return d.y > 0.999f ? Vec3{1e5f, 1e5f, 1e5f} : sky(d);
  });
  const std::vector<Vec3> under_plain = map_gloss(plain, basis), under_sun = map_gloss(sunny, basis);
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(std::min({under_sun[i].x, under_sun[i].y, under_sun[i].z}) > 0);
    // A hundred times the sky stays of the sun on the 0.0075 sr of the map's first row. One lobe, whose
    // square has the integral 0.52, takes 0.75 / 0.52 of it in each channel. The sun itself would be a
    // thousand.
    CHECK(length(under_sun[i] - under_plain[i]) < 2.6f);
  }
}
