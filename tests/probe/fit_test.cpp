// The limit of each method, and how one step of each is related to the others.
#include "sdk/src/probe/fit.h"

#include <string>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/dense.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

FitSettings with(FitMethod method, Step step = Step::fast, Denominator denominator = Denominator::lockstep) {
  FitSettings settings;
  settings.method = method;
  settings.constraint = Constraint::none;  // see light_bands_test.cpp
  settings.step = step;
  settings.denominator = denominator;
  return settings;
}

// Coefficients that lie in the basis, all positive so that non-negative forms have them too.
Coefficients planted(const Basis& basis) {
  Coefficients b;
  for (std::uint32_t i = 0; i < basis.count; ++i)
    b.push_back({1 + 0.5f * std::sin(float(i)), 0.3f + 0.2f * std::cos(2.0f * float(i)), float(1 + i % 4)});
  return b;
}

auto function_of(const Basis& basis, const Coefficients& b) {
  return [&basis, &b](Vec3 d) {
    float values[max_functions];
    evaluate_basis(basis, d, values);
    Vec3 sum;
    for (std::uint32_t i = 0; i < basis.count; ++i) sum += b[i] * values[i];
    return sum;
  };
}

double error_of(const Basis& basis, const FitSettings& settings, std::size_t count) {
  const Coefficients b = planted(basis);
  Fit fit(basis, settings);
  test::add(fit, test::sample(7, count, function_of(basis, b), basis.domain));
  const auto gram = basis_gram(basis);
  return std::sqrt(test::squared_distance(gram, test::read(fit), b) / test::squared_norm(gram, b));
}

}  // namespace

TEST_CASE("a function of the basis comes back") {
  const Basis bases[] = {vogel_basis(12),
                         vogel_basis(12, true),
                         vogel_basis(9, false, Domain::hemisphere),
                         harmonic_basis(2),
                         harmonic_basis(3, Domain::hemisphere),
                         dice_basis(),
                         dice_basis(Domain::hemisphere)};
  for (const Basis& basis : bases) {
    // The samples have no noise: what is left is the float values of the functions, 1e-6, times the
    // condition.
    CHECK(error_of(basis, with(FitMethod::least_squares), 200) < 1e-4);
    // The fast step forgets its start as the number of functions / n, 1.3e-3 for 25.
    CHECK(error_of(basis, with(FitMethod::running_average), 20000) < 3e-3);
    // The moments have the noise of the function itself: condition times n^-1/2.
    CHECK(error_of(basis, with(FitMethod::moments), 20000) < 0.15);
    if (basis.kind == BasisKind::harmonics) continue;
    CHECK(error_of(basis, with(FitMethod::non_negative_least_squares), 200) < 1e-4);
    CHECK(error_of(basis, with(FitMethod::running_average_non_negative), 20000) < 3e-3);
  }
  // The published step forgets its start slowly where lobes overlap, the original form more slowly still.
  CHECK(error_of(bases[0], with(FitMethod::running_average, Step::plain), 20000) < 0.03);
  CHECK(error_of(bases[0], with(FitMethod::running_average_non_negative, Step::plain), 20000) < 0.03);
  CHECK(error_of(bases[0], with(FitMethod::running_average, Step::plain, Denominator::precomputed), 20000) <
        0.05);
  CHECK(error_of(bases[0], with(FitMethod::running_average_original), 20000) < 0.3);
}

TEST_CASE("lobes that are nearly mixtures of each other are fitted in spite of sums in float") {
  // 24 lobes of sharpness 2: without orthonormal functions, rounding of the sums makes the system indefinite.
  const std::vector<float> sharpness(24, 2.0f);
  std::vector<Vec3> axes(24);
  vogel_sphere(axes);
  const Basis basis = gaussian_basis(axes, sharpness, false);
  for (const FitMethod method : {FitMethod::running_average, FitMethod::moments, FitMethod::least_squares}) {
    // Moments have the noise of 20,000 samples; the others the rounding of a function's values, 1e-7, times
    // the root of the condition, 1e3, and what is kept of the start.
    const double bound = method == FitMethod::moments ? 0.1 : 3e-3;
    CHECK(error_of(basis, with(method), 20000) < bound);
  }
}

TEST_CASE("few samples, or few directions, leave a small and nearly exact answer") {
  const auto light = [](Vec3 d) { return Vec3{1.5f + d.z, std::exp(d.x), 1}; };
  std::vector<Vec3> axes(24);
  vogel_sphere(axes);
  const Basis bases[] = {vogel_basis(12), gaussian_basis(axes, std::vector<float>(24, 2.0f), false),
                         harmonic_basis(4)};
  const float gather[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const Basis& basis : bases)
    for (const std::size_t count : {1, 2, 6, 11, 600}) {
      test::Samples samples = test::sample(9, count, light);
      if (count == 600)
        for (std::size_t k = 0; k < count; ++k) {
          const float* const d = gather[k % 6];
          const Vec3 rgb = light({d[0], d[1], d[2]});
          std::copy_n(d, 3, &samples.directions[3 * k]);
          const float colour[3] = {rgb.x, rgb.y, rgb.z};
          std::copy_n(colour, 3, &samples.radiance[3 * k]);
        }
      INFO(basis.count << " functions, " << count << " samples");
      Fit fit(basis, with(FitMethod::least_squares));
      test::add(fit, samples);
      const Coefficients b = test::read(fit);
      // The prior keeps 1e-4 of the answer, or ten times as much, and the sums' rounding over it adds to
      // that.
      for (std::size_t k = 0; k < std::min<std::size_t>(count, 6); ++k) {
        const float* const d = &samples.directions[3 * k];
        const Vec3 at = function_of(basis, b)({d[0], d[1], d[2]});
        CHECK(length(at - light({d[0], d[1], d[2]})) < 0.05f);
      }
      // The light at the samples is at most 3. A fit through eleven of them swings as far as 50.
      for (const Vec3& rgb : b) CHECK(length(rgb) < 100);
      FitSettings bands;
      Fit constrained(basis, bands);
      test::add(constrained, samples);
      for (const Vec3& rgb : test::read(constrained)) CHECK(length(rgb) < 100);
    }
}

TEST_CASE("a block of the running average is the system of fit.h") {
  const Basis basis = vogel_basis(12);
  const Vector<double> gram = basis_gram(basis);
  const test::Samples samples = test::sample(3, 1500, [](Vec3 d) {
    return Vec3{1 + d.z, std::exp(d.x), 0.5f + d.x * d.y};
  });
  std::vector<double> b(12, 0.0);  // of red
  for (const auto& [first, last] : {std::pair(0u, 1024u), std::pair(1024u, 1500u)}) {
    std::vector<double> system(144), change(12);
    const double before = std::max(double(first), last / 512.0) / domain_area(basis.domain);
    for (std::uint32_t i = 0; i < 144; ++i) system[i] = before * gram[i];
    for (std::uint32_t k = first; k < last; ++k) {
      const float* const d = samples.directions.data() + 3 * std::size_t(k);
      const double direction[3] = {double(d[0]), double(d[1]), double(d[2])};
      double values[max_functions], residual = double(samples.radiance[3 * std::size_t(k)]);
      evaluate_basis(basis, direction, values);
      for (std::uint32_t i = 0; i < 12; ++i) residual -= values[i] * b[i];
      for (std::uint32_t i = 0; i < 12; ++i) {
        change[i] += values[i] * residual;
        for (std::uint32_t j = 0; j < 12; ++j) system[12 * i + j] += values[i] * values[j];
      }
    }
    REQUIRE(cholesky(system.data(), 12, 1e-9) == 12);
    cholesky_solve(system.data(), 12, change.data(), 1);
    for (std::uint32_t i = 0; i < 12; ++i) b[i] += change[i];
  }
  Fit fit(basis, with(FitMethod::running_average));
  test::add(fit, samples);
  const Coefficients read = test::read(fit);
  // Rounding of values and sums, 2e-7 each, times the basis' condition of about 30.
  for (std::uint32_t i = 0; i < 12; ++i) CHECK(std::abs(double(read[i].x) - b[i]) < 2e-5);
}

TEST_CASE("naive projection gives constant light back, and blurs the rest") {
  for (const Basis& basis : {vogel_basis(12), harmonic_basis(2), dice_basis()}) {
    Fit fit(basis, with(FitMethod::naive));
    test::add(fit, test::sample(1, 20000, [](Vec3) { return Vec3{2, 1, 0.5f}; }));
    const Coefficients b = test::read(fit);
    test::Directions directions(2);
    double mean = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3 value = function_of(basis, b)(directions.next());
      mean += double(value.x) / 200;
      // Harmonics and dice make a constant exactly: what is left is the noise of 20,000 samples, 4 % at 9
      // functions. The sum of 12 lobes on a spiral has ripples of 40 %.
      CHECK(std::abs(value.x - 2) < (basis.kind == BasisKind::gaussians ? 0.85f : 0.15f));
    }
    CHECK(std::abs(mean - 2) < 0.1);
  }
  // A function of the basis does not come back.
  CHECK(error_of(vogel_basis(12), with(FitMethod::naive), 20000) > 0.1);
}

TEST_CASE("the original form is the corrected one with another step") {
  // With q = v - sum over k != i of b_k B_k, the corrected target is B q / D and the original one
  // B (q - B b) / M + b, D and M the means of B^2 and B: so gain_corrected D - gain_original M = (B^2 - D) b,
  // which vanishes on average; both have the same fixed point.
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis), integrals = basis_integrals(basis);
  const double area = domain_area(basis.domain);
  Fit start(basis, with(FitMethod::least_squares));
  test::Samples early = test::sample(11, 400, [](Vec3 d) { return Vec3{1 + d.x, 2 + d.y * d.z, 1}; });
  std::ranges::fill(early.weights,
                    1e-9f);  // so that the seed counts for nothing and the next step is a whole one
  test::add(start, early);
  const Coefficients before = test::read(start);
  test::Directions directions(12);
  for (int trial = 0; trial < 20; ++trial) {
    Fit corrected(basis, with(FitMethod::running_average, Step::plain, Denominator::precomputed));
    Fit original(basis, with(FitMethod::running_average_original));
    corrected.seed(start);
    original.seed(start);
    const Vec3 d = directions.next();
    const float v[3] = {float(3 * directions.uniform()), 1, 0};
    corrected.add_samples(&d.x, v, nullptr, 1);
    original.add_samples(&d.x, v, nullptr, 1);
    const Coefficients c = test::read(corrected), o = test::read(original);
    float values[max_functions];
    evaluate_basis(basis, d, values);
    for (std::uint32_t i = 0; i < basis.count; ++i) {
      const double mean_square = gram[i * 12 + i] / area, mean = integrals[i] / area;
      const double left = double(c[i].x - before[i].x) * mean_square - double(o[i].x - before[i].x) * mean;
      const double right = (double(values[i]) * double(values[i]) - mean_square) * double(before[i].x);
      CHECK(std::abs(left - right) < 2e-6);  // float coefficients of size 1 to 3
      // M is nearly 2 D for lobes.
      CHECK(std::abs(mean / (2 * mean_square) - 1) < 2 * std::exp(-2.0 * 6));
    }
  }
}

TEST_CASE("the original and the corrected target are equal where the derivation predicts it") {
  // One lobe, v = (1 - B) b: with b's mean b written as the sample b B / M, both targets are B (1 - B) b / D.
  const Vec3 axis[] = {{0, 0, 1}};
  const float sharpness[] = {6};
  const Basis basis = gaussian_basis(axis, sharpness, false);
  const double mean = basis_integrals(basis)[0] / domain_area(basis.domain);
  for (const float angle : {0.1f, 0.5f, 0.9f}) {
    const Vec3 d{std::sin(angle), 0, std::cos(angle)};
    const float value = gaussian_value(axis[0], 6, d), b = 2;
    Fit start(basis, with(FitMethod::least_squares));
    const float one[3] = {b, b, b}, nothing = 1e-9f;
    start.add_samples(&axis[0].x, one, &nothing, 1);
    REQUIRE(std::abs(test::read(start)[0].x - b) < 1e-5f);
    Fit corrected(basis, with(FitMethod::running_average, Step::plain, Denominator::precomputed));
    Fit original(basis, with(FitMethod::running_average_original));
    corrected.seed(start);
    original.seed(start);
    const float v[3] = {(1 - value) * b, 0, 0};
    corrected.add_samples(&d.x, v, nullptr, 1);
    original.add_samples(&d.x, v, nullptr, 1);
    const double target = double(test::read(original)[0].x) + (double(value) / mean - 1) * double(b);
    // 2 D / M is 1 + e^-12.
    CHECK(std::abs(target / double(test::read(corrected)[0].x) - 1) < 1e-4);
  }
}

TEST_CASE("a denominator in lockstep never falls below the true integral") {
  // The first sample lies where every lobe is nearly 0: an estimate from it alone would be nearly 0 too, and
  // the step without bound.
  const Vec3 axes[] = {{0, 0, 1}, {1, 0, 0}};
  const float sharpnesses[] = {20, 20};
  const Basis basis = gaussian_basis(axes, sharpnesses, false);
  const Vec3 d{0, 0, -1};
  const float v[3] = {1, 1, 1};
  Fit lockstep(basis, with(FitMethod::running_average, Step::plain));
  Fit precomputed(basis, with(FitMethod::running_average, Step::plain, Denominator::precomputed));
  lockstep.add_samples(&d.x, v, nullptr, 1);
  precomputed.add_samples(&d.x, v, nullptr, 1);
  CHECK(test::largest_difference(test::read(lockstep), test::read(precomputed)) < 1e-6);
  CHECK(length(test::read(lockstep)[0]) < 1e-6f);
  // At the axis the estimate is 1, far above: lockstep gives the value back, the true integral 40 times it.
  const Vec3 top{0, 0, 1};
  lockstep.reset();
  precomputed.reset();
  lockstep.add_samples(&top.x, v, nullptr, 1);
  precomputed.add_samples(&top.x, v, nullptr, 1);
  CHECK(std::abs(test::read(lockstep)[0].x - 1) < 1e-5f);
  CHECK(test::read(precomputed)[0].x > 30);
}

TEST_CASE("non-negative forms have no negative coefficient, and agree") {
  // A sun in a dark sky: unconstrained fits ring below 0.
  const Vec3 sun = normalised({0.3f, 0.2f, 0.9f});
  const auto sky = [&](Vec3 d) {
    const float glow = 0.1f + 30 * gaussian_value(sun, 80, d);
    return Vec3{glow, glow, 0.2f * glow};
  };
  const test::Samples samples = test::sample(5, 20000, sky);
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis);
  const auto solve = [&](FitMethod method, Step step) {
    Fit fit(basis, with(method, step));
    for (std::size_t first = 0; first < samples.size(); first += 500) {
      test::add(fit, samples, first, 500);
      if (method == FitMethod::running_average_non_negative)
        for (const Vec3 b : test::read(fit)) REQUIRE((b.x >= 0 && b.y >= 0 && b.z >= 0));
    }
    return test::read(fit);
  };
  const Coefficients free = solve(FitMethod::least_squares, Step::fast);
  CHECK(std::ranges::any_of(free, [](Vec3 b) { return b.x < 0; }));
  const Coefficients best = solve(FitMethod::non_negative_least_squares, Step::fast);
  CHECK(std::ranges::none_of(best, [](Vec3 b) { return b.x < 0 || b.y < 0 || b.z < 0; }));
  const Coefficients fast = solve(FitMethod::running_average_non_negative, Step::fast);
  const Coefficients plain = solve(FitMethod::running_average_non_negative, Step::plain);
  const double norm = test::squared_norm(gram, best);
  // 20,000 samples of a function whose variance is 10 times its fit's: both forms are 3 % from each other.
  CHECK(test::squared_distance(gram, fast, best) < 2e-3 * norm);
  CHECK(test::squared_distance(gram, plain, best) < 2e-2 * norm);
}

TEST_CASE("functions that depend on each other together are refused") {
  // 64 broad lobes: no two alike, but all of them nearly the first few harmonics.
  std::vector<Vec3> axes;
  test::Directions directions(4);
  for (int i = 0; i < 64; ++i) axes.push_back(directions.next());
  const Basis basis = gaussian_basis(axes, std::vector<float>(64, 0.2f), false);
  try {
    Fit fit(basis, {});
    FAIL("accepted");
  } catch (const Failure& failure) {
    CHECK(std::string(failure.what()).find("linear combination of the") != std::string::npos);
  }
}

TEST_CASE("settings that make no sense are refused") {
  CHECK_THROWS_AS(Fit(harmonic_basis(2), with(FitMethod::running_average_original)), Failure);
  CHECK_THROWS_AS(Fit(harmonic_basis(2), with(FitMethod::non_negative_least_squares)), Failure);
  FitSettings settings;
  settings.growing_samples = NAN;
  CHECK_THROWS_AS(Fit(vogel_basis(12), settings), Failure);
  settings.growing_samples = 0;
  settings.isa = 17;
  CHECK_THROWS_AS(Fit(vogel_basis(12), settings), Failure);
}
