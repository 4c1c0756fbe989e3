// Compares the kernels of every instruction set that this processor runs with the scalar ones, on random
// bodies and probe fits, and prints the largest differences. Exit code 1: one of them is above its bound. It
// needs no test library, so that it runs wherever the kernels do: under an emulator, in node.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "sdk/src/core/isa.h"
#include "tests/portability/kernel_body.h"

namespace {

using namespace nook;
using namespace nook::portability;

// Differences of AO, shadows and fits, relative to values above 1. A sum of 130 terms has rounding of 130 x
// 6e-8 at most, 8e-6; the roots of NEON, SSE2 and AVX2 and the power of all sets add up to 1e-5 of a value,
// once for a term and once for the root of the norm. A shadow reaches AO through weights whose absolute sum
// stays below 2.
constexpr double bound = 4e-5;
// The estimates of AVX-512 have 14 bits, and a term takes one of them: 6e-5 of it, and again through the
// weights.
constexpr double bound_of_estimates = 1.5e-4;

// Shadows that differ by rounding may have codes a step apart, which is 1/8192 of the largest, and the
// largest is below 3. The weights of a key point are below 0.2.
constexpr double bound_of_codes = 0.2 * 3 / 8192;

constexpr std::uint32_t seeds = 8;

class Row {
 public:
  explicit Row(const char* name) : name_(name) {}
  void compare(const float* a, const float* b, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) add(double(a[i]), double(b[i]));
  }
  void add(double value, double truth) {
    const double difference = std::abs(value - truth) / std::max(1.0, std::abs(truth));
    worst_ = difference >= 0 ? std::max(worst_, difference) : INFINITY;  // a NaN is infinitely wrong
  }
  bool print(const char* isa, double limit) const {
    const bool good = worst_ <= limit;
    std::printf("%-8s %-28s %9.2e%s\n", isa, name_, worst_, good ? "" : "   above the bound");
    return good;
  }

 private:
  const char* name_;
  double worst_ = 0;
};

struct Differences {
  Row spheres{"posed spheres"}, points{"posed key points"}, shadows{"shadow, all forms and norms"},
      depth{"depth of casters"}, open{"ground"}, ao{"AO of vertices"}, norm{"directional norm"},
      directional{"directional casters"}, values{"lobes at samples"}, fits{"running fits"},
      sums{"moments and Gram matrix"};
};

void compare_bodies(const ShadowKernels& kernels, const ShadowKernels& scalar, std::uint32_t seed,
                    Differences& rows) {
  Body body(seed), truth(seed);
  body.pose(kernels);
  truth.pose(scalar);
  for (std::size_t r = 0; r < 4; ++r)
    rows.spheres.compare(body.posed_spheres_rows().row(r), truth.posed_spheres_rows().row(r), Body::spheres);
  for (std::size_t r = 0; r < 12; ++r)
    rows.points.compare(body.posed_points_rows().row(r), truth.posed_points_rows().row(r), Body::key_points);
  for (const KernelForm form : {KernelForm::paper, KernelForm::rational, KernelForm::nook})
    for (const float gamma : {4.0f, 2.0f, 1.5f, 1.37f, 1.0f}) {
      body.shadow(kernels, {form, gamma});
      truth.shadow(scalar, {form, gamma});
      rows.shadows.compare(body.shadow(), truth.shadow(), Body::key_points);
    }
  body.casters(kernels);
  truth.casters(scalar);
  rows.depth.compare(body.depth(), truth.depth(), Body::key_points);
  rows.open.compare(body.open(), truth.open(), Body::key_points);
  body.blend(kernels);
  truth.blend(scalar);
  rows.ao.compare(body.ao(), truth.ao(), Body::vertices);
  body.light(kernels, {});
  truth.light(scalar, {});
  for (std::size_t r = 0; r < 12; ++r)
    (r < 3 ? rows.norm : rows.directional)
        .compare(body.coloured().row(r), truth.coloured().row(r), Body::key_points);
}

void compare_fits(const probe::FitKernels& kernels, const probe::FitKernels& scalar, std::uint32_t seed,
                  Differences& rows) {
  ProbeFit fit(seed), truth(seed);
  fit.values(kernels);
  truth.values(scalar);
  rows.values.compare(fit.values(), truth.values(), std::size_t(ProbeFit::padded) * ProbeFit::samples);
  for (const auto step : {ProbeFit::Step::plain, ProbeFit::Step::original}) {
    fit.fit(kernels, step);
    truth.fit(scalar, step);
    for (std::uint32_t c = 0; c < 3; ++c)
      rows.fits.compare(fit.coefficients(c), truth.coefficients(c), ProbeFit::lobes);
  }
  fit.sums(kernels);
  truth.sums(scalar);
  for (std::size_t i = 0; i < fit.moments().size(); ++i) rows.sums.add(fit.moments()[i], truth.moments()[i]);
  for (std::size_t f = 0; f < ProbeFit::lobes; ++f)
    for (std::size_t i = 0; i <= f; ++i)
      rows.sums.add(fit.gram()[f * ProbeFit::padded + i], truth.gram()[f * ProbeFit::padded + i]);
}

bool compare(Isa isa) {
  Differences rows;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    compare_bodies(*shadow_kernels(isa), *shadow_kernels(Isa::scalar), seed, rows);
    compare_fits(*probe::fit_kernels(isa), *probe::fit_kernels(Isa::scalar), seed, rows);
  }
  const double limit = isa == Isa::avx512 ? bound_of_estimates : bound;
  bool good = true;
  for (const Row* row : {&rows.spheres, &rows.points, &rows.shadows, &rows.depth, &rows.open, &rows.ao,
                         &rows.norm, &rows.directional, &rows.values, &rows.fits, &rows.sums})
    good &= row->print(isa_name(isa), row == &rows.ao ? limit + bound_of_codes : limit);
  return good;
}

}  // namespace

int main() {
  bool good = true;
  for (const Isa isa : all_isas) {
    if (isa == Isa::scalar) continue;
    if (isa_available(isa))
      good &= compare(isa);
    else
      std::printf("%-8s not in this build or processor\n", isa_name(isa));
  }
  std::printf(good ? "all within their bounds\n" : "differences above their bounds\n");
  return good ? 0 : 1;
}
