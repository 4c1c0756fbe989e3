// Samples: which are skipped, how weights count, and that neither calls nor seeds change more than they say.
#include <limits>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/probe_light.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

constexpr FitMethod all_methods[] = {FitMethod::naive,
                                     FitMethod::running_average,
                                     FitMethod::running_average_original,
                                     FitMethod::running_average_non_negative,
                                     FitMethod::moments,
                                     FitMethod::least_squares,
                                     FitMethod::non_negative_least_squares};

Vec3 sky(Vec3 d) {
  return {1 + d.z, 0.5f + d.x * d.y, std::exp(d.z + 0.3f * d.x)};
}

FitSettings with(FitMethod method, Step step = Step::fast) {
  FitSettings settings;
  settings.method = method;
  settings.step = step;
  return settings;
}

}  // namespace

TEST_CASE("bad samples are skipped, counted and leave no trace") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const test::Samples good = test::sample(1, 600, sky);
  for (const FitMethod method : all_methods) {
    Fit clean(vogel_basis(12), with(method)), dirty(vogel_basis(12), with(method));
    test::add(clean, good);
    test::Samples mixed;
    std::uint64_t directions = 0, radiances = 0, weights = 0;
    for (std::size_t i = 0; i < good.size(); ++i) {
      const auto put = [&](Vec3 d, Vec3 v, float w) {
        mixed.directions.insert(mixed.directions.end(), {d.x, d.y, d.z});
        mixed.radiance.insert(mixed.radiance.end(), {v.x, v.y, v.z});
        mixed.weights.push_back(w);
      };
      const Vec3 d{good.directions[3 * i], good.directions[3 * i + 1], good.directions[3 * i + 2]};
      const Vec3 v{good.radiance[3 * i], good.radiance[3 * i + 1], good.radiance[3 * i + 2]};
      if (i % 7 == 0)
        for (const Vec3 bad : {Vec3{0, 0, 0}, d * 1.01f, d * 0.99f, Vec3{nan, d.y, d.z}, Vec3{d.x, inf, 0}}) {
          put(bad, v, 1);
          ++directions;
        }
      if (i % 11 == 0)
        for (const Vec3 bad : {Vec3{nan, 0, 0}, Vec3{0, inf, 0}, Vec3{0, 0, -inf}, Vec3{2e18f, 0, 0}}) {
          put(d, bad, 1);
          ++radiances;
        }
      if (i % 13 == 0)
        for (const float bad : {nan, inf, -1.0f}) {
          put(d, v, bad);
          ++weights;
        }
      put(d, v, 1);
    }
    test::add(dirty, mixed);
    CHECK(test::read(dirty) == test::read(clean));  // to the bit
    const SampleCounts counts = dirty.counts();
    Fit single(vogel_basis(12), with(method));
    for (std::size_t i = 0; i < mixed.size(); ++i) {
      test::add(single, mixed, i, 1);
      // Samples that came one by one are in the counts at once.
      if (i % 50 == 0) CHECK(single.counts().used + single.counts().skipped() == i + 1);
    }
    CHECK(test::read(single) == test::read(dirty));
    CHECK(single.counts().skipped() == counts.skipped());
    // reset forgets the last few as well.
    test::add(single, mixed, 0, 5);
    single.reset();
    CHECK(single.counts().used + single.counts().skipped() == 0);
    CHECK(counts.used == good.size());
    CHECK(counts.bad_direction == directions);
    CHECK(counts.bad_radiance == radiances);
    CHECK(counts.bad_weight == weights);
    CHECK(counts.skipped() == directions + radiances + weights);
  }
}

TEST_CASE("samples below the hemisphere are skipped") {
  Fit fit(vogel_basis(9, false, Domain::hemisphere), {});
  test::add(fit, test::sample(1, 1000, sky));
  CHECK(fit.counts().used + fit.counts().bad_direction == 1000);
  CHECK(std::abs(double(fit.counts().used) - 500) < 80);  // 5 deviations of a fair coin
}

TEST_CASE("no samples, or samples without weight, give 0") {
  for (const FitMethod method : all_methods) {
    Fit fit(vogel_basis(12), with(method));
    CHECK(test::read(fit) == Coefficients(12));
    const Vec3 d{0, 0, 1};
    const float v[3] = {1, 1, 1}, none = 0;
    fit.add_samples(&d.x, v, &none, 1);
    CHECK(test::read(fit) == Coefficients(12));
    CHECK(fit.counts().used == 1);
    // Later samples count as if they were the first.
    Fit other(vogel_basis(12), with(method));
    test::add(fit, test::sample(1, 300, sky));
    test::add(other, test::sample(1, 300, sky));
    CHECK(test::read(fit) == test::read(other));
  }
}

// Half of the directions uniform, half within a sun of radius 0.01 that holds 60 % of the light; weights by
// the balance of both densities. The first direction meets the sun, whose weight is tiny and whose radiance
// is huge.
test::Samples sun_by_luminance(std::uint32_t seed, std::size_t count) {
  constexpr double cap = 5e-5, share = cap / 2;  // 1 - cos(0.01); of the sphere
  constexpr float sun = float(1.5 / share);
  test::Directions directions(seed);
  test::Samples samples;
  for (std::size_t i = 0; i < count; ++i) {
    Vec3 d = directions.next();
    if (i % 2 == 0) {
      const double z = 1 - cap * directions.uniform(), azimuth = 6.283185307179586 * directions.uniform();
      const double r = std::sqrt(1 - z * z);
      d = {float(r * std::cos(azimuth)), float(r * std::sin(azimuth)), float(z)};
    }
    const bool inside = i % 2 == 0;  // uniform directions meet it once in 40,000, and are taken for sky
    const float v = inside ? sun : 1.0f;
    samples.directions.insert(samples.directions.end(), {d.x, d.y, d.z});
    samples.radiance.insert(samples.radiance.end(), {v, v, v});
    samples.weights.push_back(inside ? float(2 * share) : 2.0f);
  }
  return samples;
}

TEST_CASE("a sun sampled by luminance leaves every running average near its exact fit") {
  const nook::Vector<double> gram = basis_gram(vogel_basis(12));
  for (const auto& [running, exact] :
       {std::pair(FitMethod::running_average, FitMethod::least_squares),
        std::pair(FitMethod::running_average_non_negative, FitMethod::non_negative_least_squares)})
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const test::Samples samples = sun_by_luminance(seed, 20000);
      Fit fit(vogel_basis(12), with(running)), reference(vogel_basis(12), with(exact));
      test::add(fit, samples);
      test::add(reference, samples);
      const Coefficients a = test::read(fit), b = test::read(reference);
      // 12 functions from 20,000 samples: some thousandths. Without a floor for the first weights it is
      // above 1.
      CHECK(test::squared_distance(gram, a, b) < 0.02 * test::squared_norm(gram, b));
    }
}

TEST_CASE("how samples are cut into calls does not matter, to the bit") {
  const test::Samples samples = test::sample(2, 1500, sky);
  for (const FitMethod method : all_methods)
    for (const Step step : {Step::fast, Step::plain}) {
      Fit whole(vogel_basis(12), with(method, step)), pieces(vogel_basis(12), with(method, step));
      test::add(whole, samples);
      std::size_t first = 0;
      for (std::size_t size = 1; first < samples.size(); size = size * 3 % 101) {
        const std::size_t now = std::min(size, samples.size() - first);
        test::add(pieces, samples, first, now);
        test::read(pieces);  // reading changes nothing
        first += now;
      }
      CHECK(test::read(whole) == test::read(pieces));
      Fit again(vogel_basis(12), with(method, step));
      test::add(again, samples);
      CHECK(test::read(again) == test::read(whole));
    }
}

TEST_CASE("importance sampling with weights finds the same fit") {
  // Half of the samples fall into a cap of 0.5 % of the sphere round a small sun.
  const Vec3 sun = normalised({0.2f, -0.4f, 0.9f});
  const auto light = [&](Vec3 d) {
    const float v = 0.3f + 200 * gaussian_value(sun, 400, d);
    return Vec3{v, v, 0.5f * v};
  };
  const Frame frame = frame_round(sun);
  const double share = 0.005, cap = 1 - 2 * share;
  test::Samples samples;
  test::Directions random(9);
  for (int i = 0; i < 40000; ++i) {
    Vec3 d = random.next();
    if (random.uniform() < 0.5) {
      const double z = 1 - 2 * share * random.uniform(), a = 6.283185307 * random.uniform();
      const double r = std::sqrt(1 - z * z);
      d = normalised(frame.x * float(r * std::cos(a)) + frame.y * float(r * std::sin(a)) +
                     frame.z * float(z));
    }
    const bool inside = double(dot(d, sun)) > cap;
    const Vec3 v = light(d);
    samples.directions.insert(samples.directions.end(), {d.x, d.y, d.z});
    samples.radiance.insert(samples.radiance.end(), {v.x, v.y, v.z});
    // 1 / (area p): the uniform half has density 1/2, the cap's half 1/2 of 1 / share more inside.
    samples.weights.push_back(float(1 / (0.5 + (inside ? 0.5 / share : 0))));
  }
  // The truth: with one Gaussian and a constant all integrals are closed.
  const Basis basis = vogel_basis(12, true);
  const auto gram = basis_gram(basis);
  Coefficients truth;
  {
    Fit exact(basis, with(FitMethod::least_squares));
    test::add(exact, test::sample(3, 4000000, light));
    truth = test::read(exact);
  }
  const double norm = test::squared_norm(gram, truth);
  for (const FitMethod method : {FitMethod::running_average, FitMethod::moments, FitMethod::least_squares}) {
    Fit fit(basis, with(method));
    test::add(fit, samples);
    // Relative noise of 40,000 weighted samples of the sun's light, and of the truth's 4e6 uniform ones: 2 %.
    CHECK(test::squared_distance(gram, test::read(fit), truth) < 2e-3 * norm);
    // The free ambient term keeps the mean to the noise of the samples.
    const Coefficients b = test::read(fit);
    const auto integrals = basis_integrals(basis);
    double mean = 0;
    for (std::size_t i = 0; i < b.size(); ++i)
      mean += double(b[i].x) * integrals[i] / domain_area(basis.domain);
    const double weighted = fit.counts().radiance[0] / fit.counts().weight;
    CHECK(std::abs(mean - weighted) < 0.01 * weighted);
  }
}

TEST_CASE("growing weights damp the first samples") {
  FitSettings settings = with(FitMethod::least_squares);
  settings.growing_samples = 500;
  Fit growing(vogel_basis(12), settings), plain(vogel_basis(12), with(FitMethod::least_squares));
  // The first 200 samples are wrong by far.
  const test::Samples wrong = test::sample(1, 200, [](Vec3 d) { return sky(d) * 3; });
  const test::Samples right = test::sample(2, 2000, sky);
  Fit truth(vogel_basis(12), with(FitMethod::least_squares));
  test::add(truth, right);
  for (Fit* fit : {&growing, &plain}) {
    test::add(*fit, wrong);
    test::add(*fit, right);
  }
  CHECK(std::abs(growing.counts().weight - [] {
          double sum = 0;
          for (int k = 1; k <= 2200; ++k) sum += 1 - std::exp(-k / 500.0);
          return sum;
        }()) < 1e-3);
  const auto gram = basis_gram(vogel_basis(12));
  const double with_growth = test::squared_distance(gram, test::read(growing), test::read(truth));
  const double without = test::squared_distance(gram, test::read(plain), test::read(truth));
  CHECK(with_growth < 0.2 * without);  // (18 / 1720)^2 of the weight against (200 / 2200)^2
}

TEST_CASE("with a seed, a running average starts closer to its final value") {
  const test::Samples early = test::sample(1, 300, sky), samples = test::sample(2, 100, sky);
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis);
  Fit truth(basis, with(FitMethod::least_squares));
  test::add(truth, test::sample(3, 200000, sky));
  for (const Step step : {Step::fast, Step::plain}) {
    Fit short_run(basis, with(FitMethod::least_squares));
    test::add(short_run, early);
    Fit seeded(basis, with(FitMethod::running_average, step)),
        cold(basis, with(FitMethod::running_average, step));
    seeded.seed(short_run);
    CHECK(test::largest_difference(test::read(seeded), test::read(short_run)) < 1e-6);
    test::add(seeded, samples);
    test::add(cold, samples);
    const Coefficients best = test::read(truth);
    CHECK(test::squared_distance(gram, test::read(seeded), best) <
          0.5 * test::squared_distance(gram, test::read(cold), best));
    CHECK_THROWS_AS(seeded.seed(short_run), Failure);  // it has samples
    seeded.reset();
    test::add(seeded, samples);
    CHECK(test::read(seeded) == test::read(cold));  // reset forgets the seed
  }
  Fit other(vogel_basis(11), {}), fit(basis, {});
  CHECK_THROWS_AS(fit.seed(other), Failure);
}

TEST_CASE("turning lobes and samples turns the fit") {
  const Frame turned = frame_round(normalised({0.4f, 0.5f, -0.7f}));
  const auto turn = [&](Vec3 d) { return turned.x * d.x + turned.y * d.y + turned.z * d.z; };
  const Basis basis = vogel_basis(12, true);
  std::vector<Vec3> axes;
  for (std::uint32_t i = 0; i < 12; ++i) axes.push_back(turn(basis.axis[i]));
  const Basis other = gaussian_basis(axes, std::span(basis.sharpness).first(12), true);
  const test::Samples samples = test::sample(4, 3000, sky);
  test::Samples rotated = samples;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float* d = samples.directions.data() + 3 * i;
    const Vec3 r = turn({d[0], d[1], d[2]});
    rotated.directions[3 * i] = r.x;
    rotated.directions[3 * i + 1] = r.y;
    rotated.directions[3 * i + 2] = r.z;
  }
  for (const FitMethod method : all_methods) {
    Fit fit(basis, with(method)), fit_turned(other, with(method));
    test::add(fit, samples);
    test::add(fit_turned, rotated);
    // Rounding of turned directions, 1e-7, through 3,000 steps and the condition of the ambient term, 1e3.
    CHECK(test::largest_difference(test::read(fit), test::read(fit_turned)) < 2e-3);
  }
}
