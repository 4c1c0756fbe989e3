// The comparison of ways to fit a probe measures what it says.
#include "bakers/lab/probe/probe_methods.h"

#include <algorithm>
#include <cmath>

#include "tests/bakers/probe/small_maps.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::probe;
using namespace nook::test;

TEST_CASE("the comparison: batch is the best of the progressive forms, and the original lags") {
  const Environment map = uneven_map();
  const Region sphere{Domain::sphere, {0, 1, 0}};
  ComparisonSettings settings;
  settings.seeds = 3;
  settings.baked_samples = 1u << 17;
  const std::vector<MethodError> errors =
      compare_methods(map, lab::probe_methods(12, sphere), sphere, settings);
  const auto of = [&](const std::string& name) -> const MethodError& {
    for (const MethodError& e : errors)
      if (e.method.name == name) return e;
    FAIL(name);
    return errors.front();
  };
  const MethodError &batch = of("least_squares"), &running = of("running_average");
  CHECK(std::abs(of("moments").radiance_rms / batch.radiance_rms - 1) < 1e-3);
  CHECK(std::abs(running.radiance_rms / batch.radiance_rms - 1) < 1e-2);
  CHECK(of("naive").radiance_rms > batch.radiance_rms);
  CHECK(of("non_negative_least_squares").radiance_rms >= batch.radiance_rms);
  CHECK(of("non_negative_least_squares").irradiance_minimum >= 0);
  CHECK(of("running_average_non_negative").luminance_20000.irradiance_minimum >= 0);
  CHECK(of("sh_l2").irradiance_rms < of("sh_l1").irradiance_rms);
  for (const char* form : {"running_average", "moments", "least_squares", "non_negative_least_squares"}) {
    const MethodError& bands = of(std::string(form) + ", bands");
    CHECK(bands.irradiance_rms < 0.8 * of(form).irradiance_rms);
    CHECK(std::abs(bands.mean_ratio - 1) < 5e-3);  // a million samples' noise, of the running average
  }
  // A small sun: what bands 0 to 2 of it leave is half of what least squares alone leaves.
  CHECK(of("least_squares, bands").irradiance_rms < 0.6 * batch.irradiance_rms);
  CHECK(of("sh_l2").method.floats() == 27);
  CHECK(of("ambient_dice").method.floats() == 36);
  CHECK(running.uniform_20000.excess_mse < running.uniform_1024.excess_mse);
  CHECK(of("running_average_original").uniform_20000.distance > 3 * batch.uniform_20000.distance);
  // 20,000 samples, each worth up to twice the mean: 1 % is usual for one seed.
  CHECK(std::abs(of("least_squares, ambient").luminance_20000.mean_ratio - 1) < 0.03);
}

TEST_CASE("the methods of a bake have the same errors alone and among all") {
  const Environment map = uneven_map();
  for (const Domain domain : {Domain::sphere, Domain::hemisphere}) {
    const Region region{domain, {0, 1, 0}};
    const std::vector<ProbeMethod> all = lab::probe_methods(12, region), own = own_probe_methods(12, region);
    for (const ProbeMethod& method : own) {
      const auto same = [&](const ProbeMethod& m) {
        return m.name == method.name && m.basis == method.basis && m.fit.method == method.fit.method &&
               m.fit.constraint == method.fit.constraint;
      };
      CHECK(std::count_if(all.begin(), all.end(), same) == 1);
    }
  }
}
