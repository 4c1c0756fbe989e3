// The matrix of a fit's solution against the fit itself.
#include "sdk/src/probe/fit.h"

#include <cmath>
#include <numbers>
#include <vector>

#include "sdk/src/probe/harmonics.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"

using namespace nook;
using namespace nook::probe;

namespace {

// Samples as the sums that the matrix multiplies: light times functions, then times harmonics.
std::vector<Vec3> sums_of(const Basis& basis, const std::vector<Vec3>& directions,
                          const std::vector<Vec3>& light) {
  std::vector<Vec3> sums(basis.count + band_functions);
  const float scale = float(4 * std::numbers::pi / double(light.size()));
  std::vector<float> values(sums.size());
  for (std::size_t s = 0; s < light.size(); ++s) {
    evaluate_basis(basis, directions[s], values.data());
    evaluate_harmonics(2, directions[s].x, directions[s].y, directions[s].z, values.data() + basis.count);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += light[s] * (values[i] * scale);
  }
  return sums;
}

}  // namespace

TEST_CASE("the matrix of a solution gives what the fit by moments does") {
  for (const std::uint32_t lobes : {1u, 6u, 12u, 31u})
    for (const bool ambient : {false, true})
      for (const Constraint constraint : {Constraint::bands, Constraint::none}) {
        const Basis basis = vogel_basis(lobes, ambient);
        FitSettings settings;
        settings.method = FitMethod::moments;
        settings.constraint = constraint;
        Fit fit(basis, settings);
        std::vector<Vec3> directions, light;
        for (int i = 0; i < 400; ++i) {
          const float z = 1 - (float(i) + 0.5f) / 200, r = std::sqrt(1 - z * z), angle = 2.4f * float(i);
          directions.push_back({r * std::cos(angle), r * std::sin(angle), z});
          light.push_back({1 + z, i % 7 == 0 ? 5.0f : 0.5f, r});
        }
        fit.add_samples(&directions[0].x, &light[0].x, nullptr, light.size());
        std::vector<Vec3> expected(basis.count);
        fit.read(expected);
        const Vector<double> map = solution_map(basis, constraint);
        const std::vector<Vec3> sums = sums_of(basis, directions, light);
        float largest = 0, worst = 0;
        for (std::uint32_t i = 0; i < basis.count; ++i) {
          Vec3 found;
          for (std::size_t k = 0; k < sums.size(); ++k) found += sums[k] * float(map[i * sums.size() + k]);
          largest = std::max(largest, length(expected[i]));
          worst = std::max(worst, length(found - expected[i]));
        }
        INFO("lobes " << lobes << ", ambient " << ambient << ", constraint " << int(constraint));
        // Sums and products of this test are floats, whose rounding the inverse of the Gram matrix enlarges
        // by its condition, which is below 1e3 for these lobes.
        CHECK(worst < 1e-3f * largest);
      }
}
