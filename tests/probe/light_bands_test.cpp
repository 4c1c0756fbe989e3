// Lobes that agree with a light's bands 0 to 2: what they agree in, what it is worth, and what is left to
// least squares.
#include "sdk/src/probe/fit_bands.h"

#include "sdk/src/probe/fit.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

// A sky with a sun of 5 degrees that holds half of the light, dark ground, and another colour on each side.
Vec3 light(Vec3 d) {
  const Vec3 sun = normalised(Vec3{0.4f, 0.3f, 0.8f});
  const float glow = 600 * gaussian_value(sun, 400, d), sky = d.z > 0 ? 1 + d.z : 0.2f;
  return Vec3{sky + glow, sky + 0.8f * glow, sky * (1.5f + 0.5f * d.x) + 0.5f * glow};
}

// The integral of what the light is over directions, by samples that a rule of 128 x 128 directions weighs:
// its error on this light is below 1e-4.
test::Samples rule_of(Domain domain) {
  test::Samples samples;
  const auto add = [&](double x, double y, double z, double weight) {
    const Vec3 d{float(x), float(y), float(z)}, v = light(d);
    samples.directions.insert(samples.directions.end(), {d.x, d.y, d.z});
    samples.radiance.insert(samples.radiance.end(), {v.x, v.y, v.z});
    samples.weights.push_back(float(weight));
  };
  constexpr int heights = 256, azimuths = 256;
  for (int i = 0; i < heights; ++i)
    for (int k = 0; k < azimuths; ++k) {
      const double lowest = domain == Domain::sphere ? -1 : 0;
      const double z = lowest + (1 - lowest) * (i + 0.5) / heights, r = std::sqrt(1 - z * z);
      const double azimuth = 6.283185307179586 * (k + 0.5) / azimuths;
      add(r * std::cos(azimuth), r * std::sin(azimuth), z, 1);
    }
  return samples;
}

Coefficients fitted(const Basis& basis, FitMethod method, Constraint constraint,
                    const test::Samples& samples) {
  FitSettings settings;
  settings.method = method;
  settings.constraint = constraint;
  Fit fit(basis, settings);
  test::add(fit, samples);
  return test::read(fit);
}

// RGB of bands 0 to 2, band by band.
std::vector<Vec3> bands_of(const Basis& basis, const Coefficients& b) {
  std::vector<SphericalGaussian> lobes(basis.count);
  to_lobes(basis, b, lobes);
  std::vector<Vec3> bands(band_functions);
  to_harmonics(lobes, 2, bands);
  return bands;
}

std::vector<Vec3> bands_of(const test::Samples& samples) {
  std::vector<Vec3> bands(band_functions);
  double values[band_functions];
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const float *d = &samples.directions[3 * s], *v = &samples.radiance[3 * s];
    evaluate_harmonics(2, double(d[0]), double(d[1]), double(d[2]), values);
    for (std::size_t j = 0; j < band_functions; ++j)
      bands[j] += Vec3{v[0], v[1], v[2]} * float(values[j] * 4 * 3.141592653589793 / double(samples.size()));
  }
  return bands;
}

double largest_gap(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  return test::largest_difference(a, b) / double(length(b[0]));
}

// Root mean square over normals and channels, relative to the mean.
double irradiance_error(const Basis& basis, const Coefficients& b, const test::Samples& samples,
                        Domain domain) {
  test::Directions directions(3, domain);
  double square = 0, mean = 0;
  constexpr int normals = 200;
  for (int i = 0; i < normals; ++i) {
    const Vec3 n = directions.next();
    Vec3 truth;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const float *d = &samples.directions[3 * s], *v = &samples.radiance[3 * s];
      truth += Vec3{v[0], v[1], v[2]} * std::max(n.x * d[0] + n.y * d[1] + n.z * d[2], 0.0f);
    }
    truth = truth * float(domain_area(domain) / double(samples.size()));
    const Vec3 off = irradiance(basis, b, IrradianceForm::bands, n) - truth;
    square += double(dot(off, off)) / (3 * normals);
    mean += double(truth.x + truth.y + truth.z) / (3 * normals);
  }
  return std::sqrt(square) / mean;
}

}  // namespace

TEST_CASE("lobes have the light's harmonics of bands 0 to 2") {
  const test::Samples samples = rule_of(Domain::sphere);
  const std::vector<Vec3> truth = bands_of(samples);
  for (const Basis& basis : {vogel_basis(12), vogel_basis(12, true), vogel_basis(24)}) {
    for (const FitMethod method : {FitMethod::least_squares, FitMethod::moments})
      // Sums in float over 65,536 samples, and the rule's error in the functions' own bands.
      CHECK(largest_gap(bands_of(basis, fitted(basis, method, Constraint::bands, samples)), truth) < 1e-3);
    CHECK(largest_gap(bands_of(basis, fitted(basis, FitMethod::least_squares, Constraint::none, samples)),
                      truth) > 0.05);
  }
}

TEST_CASE("with exact bands, the other degrees of freedom are fitted by least squares") {
  // Of all coefficients with these bands no others have less square error: its slope, G b - m, has no part
  // along directions that leave the bands alone, and is a sum of the bands' rows.
  const Basis basis = vogel_basis(12);
  const test::Samples samples = rule_of(Domain::sphere);
  const Coefficients b = fitted(basis, FitMethod::moments, Constraint::bands, samples),
                     free = fitted(basis, FitMethod::moments, Constraint::none, samples);
  const auto gram = basis_gram(basis);
  double slope[12];
  for (std::size_t i = 0; i < 12; ++i) {
    slope[i] = 0;
    for (std::size_t k = 0; k < 12; ++k) slope[i] += gram[i * 12 + k] * double(b[k].x - free[k].x);
  }
  std::array<double, band_functions * max_functions> rows;
  project_functions(basis, rows.data());
  double before = 0, after = 0;
  for (const double s : slope) before += s * s;
  // Gram-Schmidt takes the rows' part away.
  for (std::size_t j = 0; j < band_functions; ++j) {
    double* const row = rows.data() + 12 * j;
    for (std::size_t other = 0; other < j; ++other) {
      double along = 0;
      for (std::size_t i = 0; i < 12; ++i) along += row[i] * rows[12 * other + i];
      for (std::size_t i = 0; i < 12; ++i) row[i] -= along * rows[12 * other + i];
    }
    double size = 0, along = 0;
    for (std::size_t i = 0; i < 12; ++i) size += row[i] * row[i];
    for (std::size_t i = 0; i < 12; ++i) row[i] /= std::sqrt(size);
    for (std::size_t i = 0; i < 12; ++i) along += row[i] * slope[i];
    for (std::size_t i = 0; i < 12; ++i) slope[i] -= along * row[i];
  }
  for (const double s : slope) after += s * s;
  CHECK(before > 1e-3);
  CHECK(after < 1e-6 * before);  // float coefficients
}

TEST_CASE("irradiance gains by the bands in every form") {
  const test::Samples samples = rule_of(Domain::sphere);
  const Basis basis = vogel_basis(12);
  const auto error = [&](FitMethod method, Constraint constraint) {
    return irradiance_error(basis, fitted(basis, method, constraint, samples), samples, Domain::sphere);
  };
  for (const FitMethod method : {FitMethod::least_squares, FitMethod::moments})
    CHECK(error(method, Constraint::bands) < 0.65 * error(method, Constraint::none));
  CHECK(error(FitMethod::non_negative_least_squares, Constraint::bands) <
        0.7 * error(FitMethod::non_negative_least_squares, Constraint::none));
  const test::Samples random = test::sample(9, 20000, light);
  for (const FitMethod method : {FitMethod::running_average, FitMethod::running_average_non_negative}) {
    const auto of_random = [&](Constraint constraint) {
      return irradiance_error(basis, fitted(basis, method, constraint, random), samples, Domain::sphere);
    };
    CHECK(of_random(Constraint::bands) < 0.8 * of_random(Constraint::none));
  }
  const Basis half = vogel_basis(12, false, Domain::hemisphere);
  const test::Samples upper = rule_of(Domain::hemisphere);
  const auto of_half = [&](Constraint constraint) {
    return irradiance_error(half, fitted(half, FitMethod::least_squares, constraint, upper), upper,
                            Domain::hemisphere);
  };
  CHECK(of_half(Constraint::bands) < 0.75 * of_half(Constraint::none));
}

TEST_CASE("the total light is exact, with few lobes and without negative ones") {
  const test::Samples samples = rule_of(Domain::sphere);
  const Vec3 truth = bands_of(samples)[0];
  const auto total = [&](const Basis& basis, FitMethod method, Constraint constraint) {
    const Vec3 found = bands_of(basis, fitted(basis, method, constraint, samples))[0];
    return std::abs(double(found.x) / double(truth.x) - 1);
  };
  // A thousand times the weight of band 1, whose gap is some per cent here.
  for (const std::uint32_t lobes : {1u, 4u, 6u, 8u})
    CHECK(total(vogel_basis(lobes), FitMethod::least_squares, Constraint::bands) < 2e-3);
  for (const std::uint32_t lobes : {6u, 12u, 24u})
    CHECK(total(vogel_basis(lobes), FitMethod::non_negative_least_squares, Constraint::bands) < 2e-3);
  CHECK(total(vogel_basis(12), FitMethod::non_negative_least_squares, Constraint::none) > 0.02);
  for (const Vec3 b :
       fitted(vogel_basis(12), FitMethod::non_negative_least_squares, Constraint::bands, samples))
    CHECK((b.x >= 0 && b.y >= 0 && b.z >= 0));
}

TEST_CASE("bands merge, start from a short run, and are forgotten") {
  const Basis basis = vogel_basis(12);
  const test::Samples samples = test::sample(5, 4000, light);
  for (const FitMethod method :
       {FitMethod::moments, FitMethod::least_squares, FitMethod::non_negative_least_squares}) {
    FitSettings settings;
    settings.method = method;
    Fit whole(basis, settings), first(basis, settings), second(basis, settings);
    test::add(whole, samples);
    test::add(first, samples, 0, 1500);
    test::add(second, samples, 1500);
    first.merge(second);
    CHECK(test::largest_difference(test::read(first), test::read(whole)) <
          1e-5 * double(length(test::read(whole)[0])) + 1e-4);
    whole.reset();
    CHECK(test::largest_difference(test::read(whole), Coefficients(12)) == 0);
  }
  // A running average that starts from another one, without a sample of its own, has its bands.
  FitSettings running;
  running.method = FitMethod::running_average;
  Fit short_run(basis, running), seeded(basis, running);
  test::add(short_run, samples, 0, 500);
  seeded.seed(short_run);
  CHECK(largest_gap(bands_of(basis, test::read(seeded)), bands_of(basis, test::read(short_run))) < 1e-4);
  seeded.seed(short_run);  // a second start replaces the first
  CHECK(largest_gap(bands_of(basis, test::read(seeded)), bands_of(basis, test::read(short_run))) < 1e-4);
  // Fits that differ in the constraint alone do not merge.
  FitSettings none = running;
  none.constraint = Constraint::none;
  Fit other(basis, none);
  CHECK_THROWS(short_run.merge(other));
}

TEST_CASE("light that lobes make exactly leaves no noise in the bands") {
  // 60 samples: moments of the bands alone would be off by some ten per cent.
  const Basis basis = vogel_basis(12);
  Coefficients b(12);
  for (std::size_t i = 0; i < 12; ++i) b[i] = {1 + 0.5f * std::sin(float(i)), 1, float(i % 4)};
  const auto made = [&](Vec3 d) { return radiance(basis, b, d); };
  const Coefficients found =
      fitted(basis, FitMethod::least_squares, Constraint::bands, test::sample(21, 60, made));
  CHECK(test::largest_difference(found, b) < 1e-3);
}
