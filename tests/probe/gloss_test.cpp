// Amplitudes for gloss: a planted light comes back, lamps leave no black, and the light's own stay as they
// are.
#include "sdk/src/probe/gloss.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::probe;

namespace {

constexpr std::uint32_t lobes = 12;

// A dim room with one lamp of a hundred times its light.
Vec3 lamp(Vec3 d) {
  return d.z > 0.95f ? Vec3{100, 100, 60} : Vec3{1, 0.8f, 1};
}

template <class Light>
void add_light(Fit& fit, Light&& light) {
  std::vector<Vec3> direction(8192), radiance;
  vogel_sphere(direction);
  // Running averages need an order without system: an odd stride visits all places of a power of two.
  std::vector<Vec3> mixed;
  for (std::size_t i = 0; i < direction.size(); ++i) mixed.push_back(direction[i * 3181 % direction.size()]);
  direction = mixed;
  for (const Vec3 d : direction) radiance.push_back(light(d));
  fit.add_samples(&direction[0].x, &radiance[0].x, nullptr, direction.size());
}

float lowest(const std::vector<Vec3>& values) {
  float least = values[0].x;
  for (const Vec3 v : values) least = std::min({least, v.x, v.y, v.z});
  return least;
}

constexpr FitMethod solving[] = {FitMethod::moments, FitMethod::least_squares,
                                 FitMethod::non_negative_least_squares};
constexpr FitMethod running[] = {FitMethod::running_average, FitMethod::running_average_non_negative};

}  // namespace

TEST_CASE("gloss finds planted amplitudes that are not far below the light around them") {
  const Basis basis = vogel_basis(lobes);
  const Vector<double> gram = basis_gram(basis);
  std::vector<double> planted(lobes), moment(lobes), found(lobes), scratch(gloss_scratch_size(lobes));
  for (std::size_t i = 0; i < lobes; ++i) planted[i] = 2 + 0.25 * double(i % 4);
  for (std::size_t i = 0; i < lobes; ++i)
    for (std::size_t k = 0; k < lobes; ++k) moment[i] += gram[i * lobes + k] * planted[k];
  fit_gloss(gram.data(), moment.data(), lobes, 1, found.data(), scratch.data());
  // Twelve equations in double precision, whose condition is below 100.
  for (std::size_t i = 0; i < lobes; ++i) CHECK(std::abs(found[i] - planted[i]) < 1e-9);
}

TEST_CASE("gloss under a lamp is not below 0.6 of the blurred light, where the light's lobes ring") {
  const Basis basis = vogel_basis(lobes);
  const Vector<double> gram = basis_gram(basis);
  for (const FitMethod method : solving) {
    FitSettings settings;
    settings.method = method;
    Fit fit(basis, settings);
    add_light(fit, lamp);
    std::vector<Vec3> light(lobes), gloss(lobes), after(lobes);
    fit.read(light);
    fit.read_gloss(gloss);
    fit.read(after);
    CHECK(std::memcmp(light.data(), after.data(), lobes * sizeof(Vec3)) == 0);
    if (method != FitMethod::non_negative_least_squares) CHECK(lowest(light) < -1);
    // The blurred light of a lobe is the room's, 0.8 in green, to 5 %, because the lobes' sum is not
    // constant. Of it 0.6 are left.
    CHECK(lowest(gloss) > 0.45f);
  }
}

TEST_CASE("gloss is the same of every method that sees the same samples") {
  const Basis basis = vogel_basis(lobes);
  std::vector<Vec3> exact(lobes), gloss(lobes);
  FitSettings settings;
  Fit fit(basis, settings);
  add_light(fit, lamp);
  fit.read_gloss(exact);
  float largest = 0;
  for (const Vec3 v : exact) largest = std::max({largest, v.x, v.y, v.z});
  const auto check = [&](FitMethod method, float tolerance) {
    settings.method = method;
    Fit other(basis, settings);
    add_light(other, lamp);
    other.read_gloss(gloss);
    for (std::size_t i = 0; i < lobes; ++i)
      for (const float d : {gloss[i].x - exact[i].x, gloss[i].y - exact[i].y, gloss[i].z - exact[i].z})
        CHECK(std::abs(d) <= tolerance * largest);
  };
  // 8,192 even directions have the exact Gram matrix to about 1e-3.
  for (const FitMethod method : solving) check(method, 0.01f);
  // After eight blocks a running average has forgotten its start but for a few hundredths.
  for (const FitMethod method : running) check(method, 0.1f);
}

TEST_CASE("gloss of a fit without samples is black, and harmonics have none") {
  std::vector<Vec3> gloss(lobes, Vec3{1, 1, 1});
  Fit fit(vogel_basis(lobes), {});
  fit.read_gloss(gloss);
  for (const Vec3 v : gloss) CHECK((v.x == 0 && v.y == 0 && v.z == 0));
  Fit harmonics(harmonic_basis(2), {});
  gloss.resize(9);
  CHECK_THROWS_AS(harmonics.read_gloss(gloss), Failure);
}
