// Every instruction set against the scalar reference and the exponential itself.
#include "sdk/src/probe/fit_kernels.h"

#include "tests/catch.h"
#include "tests/probe/samples.h"

using namespace nook;
using namespace nook::probe;

namespace {

Vec3 sky(Vec3 d) {
  return {1 + d.z, 0.5f + d.x * d.y, std::exp(d.z + 0.3f * d.x)};
}

}  // namespace

TEST_CASE("values of lobes in every instruction set") {
  alignas(64) float x[16] = {0.6f, 0, -1}, y[16] = {0.8f, 0, 0}, z[16] = {0, 1, 0},
                    sharpness[16] = {6, 1e4f, 0.3f};
  for (int i = 3; i < 16; ++i) sharpness[i] = 1e4f;
  const LobeSoa lobes{x, y, z, sharpness, 16};
  constexpr std::uint32_t count = 37;
  SampleColumns samples{};
  test::Directions directions(5);
  for (std::uint32_t k = 0; k < count; ++k) {
    const Vec3 d = k == 0 ? Vec3{0, 0, 1} : directions.next();
    samples.x[k] = d.x;
    samples.y[k] = d.y;
    samples.z[k] = d.z;
  }
  for (const Isa isa : all_isas) {
    const FitKernels* kernels = fit_kernels(isa);
    if (!kernels) continue;
    std::vector<float> values(std::size_t(count) * 16), rows(std::size_t(sample_chunk) * 3),
        twos(sample_chunk, 2.0f);
    kernels->gaussian_values(lobes, samples, count, values.data());
    kernels->gaussian_rows(lobes, 3, samples, twos.data(), count, rows.data());
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const float truth =
            gaussian_value({x[i], y[i], z[i]}, sharpness[i], {samples.x[k], samples.y[k], samples.z[k]});
        // 2e-7 of the exponential; rounding of its argument, up to 80, 6e-8 each.
        REQUIRE(std::abs(values[k * 16 + i] - truth) <= 6e-6f * truth + 2e-38f);
        REQUIRE(std::abs(0.5f * rows[i * sample_chunk + k] - truth) <= 6e-6f * truth + 2e-38f);
      }
      for (std::size_t i = 3; i < 16; ++i) REQUIRE(values[k * 16 + i] < 1e-30f);  // padding
    }
  }
}

TEST_CASE("every instruction set gives the same fit") {
  const test::Samples samples = test::sample(3, 3000, sky);
  for (const FitMethod method :
       {FitMethod::naive, FitMethod::running_average, FitMethod::running_average_original,
        FitMethod::running_average_non_negative, FitMethod::moments, FitMethod::least_squares})
    for (const Step step : {Step::fast, Step::plain}) {
      test::Coefficients reference;
      for (const Isa isa : all_isas) {
        if (!fit_kernels(isa)) continue;
        FitSettings settings;
        settings.method = method;
        settings.step = step;
        settings.isa = nook_isa(isa);
        Fit fit(vogel_basis(21, true), settings);
        test::add(fit, samples);
        const test::Coefficients answer = test::read(fit);
        if (isa == Isa::scalar) reference = answer;
        // Rounding of 3,000 float steps, 6e-8 each, times the basis' condition of about 30.
        CHECK(test::largest_difference(answer, reference) < 3e-4);
      }
    }
}
