// Two fits, joined.
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"

using namespace nook;
using namespace nook::probe;
using test::Coefficients;

namespace {

Vec3 sky(Vec3 d) {
  return {1 + d.z, 0.5f + d.x * d.y, std::exp(d.z + 0.3f * d.x)};
}

FitSettings with(FitMethod method) {
  FitSettings settings;
  settings.method = method;
  return settings;
}

}  // namespace

TEST_CASE("forms that solve merge exactly") {
  const test::Samples samples = test::sample(1, 5000, sky);
  for (const FitMethod method : {FitMethod::naive, FitMethod::moments, FitMethod::least_squares,
                                 FitMethod::non_negative_least_squares}) {
    Fit whole(vogel_basis(12), with(method)), a(vogel_basis(12), with(method)),
        b(vogel_basis(12), with(method));
    test::add(whole, samples);
    test::add(a, samples, 0, 1777);
    test::add(b, samples, 1777);
    a.merge(b);
    // Sums of doubles in another order, 1e-13, round to the same floats but for a last bit.
    CHECK(test::largest_difference(test::read(a), test::read(whole)) < 1e-6);
    CHECK(a.counts().used == 5000);
    CHECK(a.counts().weight == whole.counts().weight);
    CHECK(b.counts().used == 5000 - 1777);  // as it was
    // And in the same order, to the bit.
    Fit again(vogel_basis(12), with(method));
    test::add(again, samples, 0, 1777);
    again.merge(b);
    CHECK(test::read(again) == test::read(a));
  }
}

TEST_CASE("running averages merge to within their own error") {
  // Order matters to them: the merged fit is the mean of two shorter ones. With the fast step its distance to
  // least squares over all samples stays within twice the distance of the whole run; 20 seeds.
  const Basis basis = vogel_basis(12);
  const auto gram = basis_gram(basis);
  FitSettings exact = with(FitMethod::least_squares), average = with(FitMethod::running_average);
  exact.constraint = average.constraint = Constraint::none;
  Fit truth(basis, exact);
  test::add(truth, test::sample(999, 1000000, sky));
  const Coefficients best = test::read(truth);
  double merged = 0, whole_run = 0, reversed = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const test::Samples samples = test::sample(seed, 4000, sky);
    Fit whole(basis, average), a(basis, average), b(basis, average), backwards(basis, average);
    test::add(whole, samples);
    test::add(a, samples, 0, 2000);
    test::add(b, samples, 2000);
    a.merge(b);
    for (std::size_t i = samples.size(); i-- > 0;) test::add(backwards, samples, i, 1);
    merged += test::squared_distance(gram, test::read(a), best);
    whole_run += test::squared_distance(gram, test::read(whole), best);
    reversed += test::squared_distance(gram, test::read(whole), test::read(backwards));
  }
  CHECK(merged < 2 * whole_run);
  CHECK(whole_run < 2 * merged);
  // The same samples backwards move the fit by less than its error.
  CHECK(reversed > 0);
  CHECK(reversed < whole_run);
}

TEST_CASE("merging empty fits and going on") {
  const test::Samples samples = test::sample(1, 2000, sky);
  for (const FitMethod method : {FitMethod::running_average, FitMethod::least_squares}) {
    Fit fit(vogel_basis(12), with(method)), empty(vogel_basis(12), with(method)),
        plain(vogel_basis(12), with(method));
    test::add(fit, samples, 0, 1000);
    fit.merge(empty);
    empty.merge(fit);
    CHECK(test::largest_difference(test::read(empty), test::read(fit)) == 0);
    test::add(fit, samples, 1000);
    test::add(plain, samples);
    CHECK(test::largest_difference(test::read(fit), test::read(plain)) < 1e-5);
  }
}

TEST_CASE("fits that differ do not merge") {
  Fit fit(vogel_basis(12), with(FitMethod::moments));
  Fit lobes(vogel_basis(13), with(FitMethod::moments)), method(vogel_basis(12), with(FitMethod::naive));
  Fit domain(vogel_basis(12, false, Domain::hemisphere), with(FitMethod::moments));
  for (Fit* other : {&lobes, &method, &domain, &fit}) CHECK_THROWS_AS(fit.merge(*other), Failure);
}
