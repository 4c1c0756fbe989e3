// Integrals of every basis over both domains against brute force, and what is refused.
#include "sdk/src/probe/basis.h"

#include <string>

#include "sdk/src/core/failure.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/harmonics.h"
#include "tests/catch.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;

namespace {

std::string refusal(std::span<const Vec3> axes, std::span<const float> sharpnesses, bool ambient) {
  try {
    gaussian_basis(axes, sharpnesses, ambient);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
    return failure.what();
  }
  return "";
}

// Brute force over the hemisphere round +z; `up` is +z in these tests.
double inner(const Basis& basis, std::uint32_t i, std::uint32_t k) {
  const auto product = [&](double x, double y, double z) {
    const double d[3] = {x, y, z};
    double values[max_functions];
    evaluate_basis(basis, d, values);
    return values[i] * values[k];
  };
  return basis.domain == Domain::sphere ? test::integrate_sphere(product, 0, std::numbers::pi, 200, 120)
                                        : test::integrate_sphere(product, 0, std::numbers::pi / 2, 200, 120);
}

double mean_of(const Basis& basis, std::uint32_t i) {
  const auto value_at = [&](double x, double y, double z) {
    const double d[3] = {x, y, z};
    double values[max_functions];
    evaluate_basis(basis, d, values);
    return values[i];
  };
  return basis.domain == Domain::sphere ? test::integrate_sphere(value_at)
                                        : test::integrate_hemisphere(value_at);
}

void check_integrals(const Basis& basis, double tolerance) {
  const auto gram = basis_gram(basis);
  const auto integrals = basis_integrals(basis);
  const std::uint32_t n = basis.count;
  for (std::uint32_t i = 0; i < n; i += 2) {
    CHECK(std::abs(integrals[i] - mean_of(basis, i)) < tolerance);
    for (std::uint32_t k = 0; k < n; k += 3) {
      CHECK(std::abs(gram[i * n + k] - inner(basis, i, k)) < tolerance);
      CHECK(gram[i * n + k] == gram[k * n + i]);
    }
  }
}

}  // namespace

TEST_CASE("Gram matrices and integrals of all bases over both domains") {
  for (const Domain domain : {Domain::sphere, Domain::hemisphere}) {
    // Simpson's rule with 200 steps: 1e-7 on these smooth functions of integral about 1.
    check_integrals(vogel_basis(12, true, domain), 1e-6);
    check_integrals(harmonic_basis(4, domain), 1e-6);
    // The dice's functions have a kink in their third derivative, for either quadrature.
    check_integrals(dice_basis(domain), 1e-5);
  }
  // Sharp, broad and below the horizon.
  const Vec3 axes[] = {{0, 0, 1}, normalised({1, 0, 0.05f}), normalised({0, 1, -0.3f}), {0, 0, -1}};
  const float sharpnesses[] = {80, 30, 0.2f, 3};
  check_integrals(gaussian_basis(axes, sharpnesses, true, Domain::hemisphere), 1e-6);
}

TEST_CASE("a hemisphere may lie anywhere") {
  // The Gram matrix depends on how the axes lie to `up` alone.
  const Vec3 up = normalised({0.5f, -0.7f, 0.2f});
  const auto upright = basis_gram(vogel_basis(9, false, Domain::hemisphere));
  const auto tilted = basis_gram(vogel_basis(9, false, Domain::hemisphere, up));
  for (std::size_t i = 0; i < upright.size(); ++i) CHECK(std::abs(upright[i] - tilted[i]) < 1e-6);
}

TEST_CASE("harmonics are orthonormal over the sphere") {
  const Basis basis = harmonic_basis(4);
  const auto gram = basis_gram(basis);
  for (std::uint32_t i = 0; i < basis.count; ++i)
    for (std::uint32_t k = 0; k < basis.count; ++k)
      CHECK(std::abs(gram[i * basis.count + k] - (i == k)) < 1e-12);  // the rule is exact for them
}

TEST_CASE("Vogel axes are spread evenly") {
  for (const std::uint32_t count : {5u, 12u, 24u, 64u}) {
    const Basis sphere = vogel_basis(count), half = vogel_basis(count, false, Domain::hemisphere);
    Vec3 sum;
    for (std::uint32_t i = 0; i < count; ++i) {
      sum += sphere.axis[i];
      CHECK(std::abs(length(sphere.axis[i]) - 1) < 1e-6f);
      CHECK(half.axis[i].z > 0);
    }
    CHECK(length(sum) < 0.1f * float(count));
    float nearest = 2;
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t k = 0; k < i; ++k)
        nearest = std::min(nearest, length(sphere.axis[i] - sphere.axis[k]));
    // Perfect packing would have about sqrt(14.5 / count) between neighbours.
    CHECK(nearest > 0.7f * std::sqrt(14.5f / float(count)));
  }
}

TEST_CASE("two lobes that are the same are refused and named") {
  Vec3 axes[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  float sharpnesses[] = {6, 6, 6, 6};
  std::string text = refusal(axes, sharpnesses, false);
  CHECK(text.find("lobe 3") == 0);
  CHECK(text.find("same function as lobe 1") != std::string::npos);
  sharpnesses[3] = 12;  // the same axis, another width: a function of its own
  CHECK(refusal(axes, sharpnesses, false).empty());
  axes[3] = normalised({1, 1e-4f, 0});
  sharpnesses[3] = 6.0001f;
  CHECK(refusal(axes, sharpnesses, false).find("same function as lobe 1") != std::string::npos);
  // Nearly constant, beside the ambient term.
  axes[3] = {0, 0, -1};
  sharpnesses[3] = 1e-4f;
  text = refusal(axes, sharpnesses, true);
  CHECK(text.find("the ambient term, lobe 4") == 0);
  CHECK(text.find("lobe 3;") != std::string::npos);
}

TEST_CASE("lobes out of range are refused") {
  const Vec3 axes[] = {{0, 0, 1}, {0, 1, 0}};
  const float good[] = {6, 6};
  CHECK(refusal(axes, good, true).empty());
  for (const float bad : {0.0f, -1.0f, 2e4f, NAN, INFINITY}) {
    const float sharpnesses[] = {6, bad};
    CHECK(refusal(axes, sharpnesses, false).find("sharpness of lobe 1") != std::string::npos);
  }
  for (const Vec3 bad : {Vec3{0, 0, 0}, Vec3{0, 2, 0}, Vec3{NAN, 0, 1}}) {
    const Vec3 wrong[] = {bad, {0, 1, 0}};
    CHECK(refusal(wrong, good, false).find("axis of lobe 0") != std::string::npos);
  }
  CHECK(refusal({}, {}, true).find("number of lobes") != std::string::npos);
  std::vector<Vec3> many(65, Vec3{0, 0, 1});
  CHECK(refusal(many, std::vector<float>(65, 6.0f), false).find("got 65") != std::string::npos);
  CHECK_THROWS_AS(harmonic_basis(5), Failure);
  CHECK_THROWS_AS(harmonic_basis(2, Domain::hemisphere, {0, 0, 2}), Failure);
}
