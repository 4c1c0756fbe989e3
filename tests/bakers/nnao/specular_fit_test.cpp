// The fit of the specular occlusion: planted answers come back, and the same seed gives the same numbers.
#include "bakers/nnao/specular_fit.h"

#include <cmath>

#include "bakers/raytrace/random.h"
#include "sdk/src/nnao/network_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::nnao;

namespace {

Vec3 any_direction(Random& random) {
  return normalised({random.between(-1, 1), random.between(-1, 1), random.between(0.2f, 1)});
}

// Points whose reflections are as open as the numbers in use say.
std::vector<SpecularSample> planted(std::size_t count) {
  const nook::nnao::SpecularNumbers numbers = nook::nnao::specular_numbers();
  Random random(5);
  std::vector<SpecularSample> samples(count);
  for (SpecularSample& sample : samples) {
    sample.reference = {any_direction(random), {0, 0, 1}, any_direction(random), random.unit()};
    sample.network = sample.reference;
    for (std::size_t i = 0; i < SpecularSample::gloss_count; ++i) {
      sample.roughness[i] = random.unit();
      sample.visible[i] = nook::nnao::specular_occlusion(numbers, sample.reference, sample.roughness[i]);
    }
  }
  return samples;
}

}  // namespace

TEST_CASE("a fit recovers planted reflections") {
  SpecularFitSettings settings;
  settings.steps = 6000;
  const std::vector<SpecularSample> samples = planted(2000);
  const SpecularError error = specular_error(samples, fit_specular(samples, settings));
  // The planted values spread by 0.1 in the square; short fits of eight units leave a few hundredths of it.
  CHECK(error.fitted < 4e-3);
  CHECK(error.fitted < 0.1 * error.lagarde);
}

TEST_CASE("samples and fit depend on the seed alone") {
  const nook::nnao::Network network = nook::nnao::read_network(nook::nnao::default_network_file());
  SpecularFitSettings settings;
  settings.data.scenes = settings.data.views = 48;
  settings.data.points_per_view = 20;
  settings.data.rays = 16;
  settings.rays = 8;
  settings.steps = 50;
  const auto header = [&] {
    return specular_header(fit_specular(trace_specular_samples(network, settings).training, settings),
                           settings);
  };
  const std::string first = header();
  CHECK(header() == first);
  settings.seed = 2;
  CHECK(header() != first);
}

TEST_CASE("Lagarde's form is AO for rough surfaces and leaves open ones open") {
  CHECK(std::abs(lagarde_occlusion(0.4f, 0.7f, 1) - 0.4f) < 1e-3f);
  CHECK(lagarde_occlusion(1, 0.3f, 0.2f) == 1);
}
