#include "sdk/src/probe/basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/core/checks.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/harmonics.h"

namespace nook::probe {
namespace {

// Two functions with at least this correlation are treated as equal, because rounding errors would determine
// their coefficients in a fit.
constexpr double same_function = 1 - 1e-6;

const char* lobe_name(const Basis& basis, std::uint32_t i) {
  return basis.ambient && i + 1 == basis.count ? "the ambient term, lobe" : "lobe";
}

void check_direction(Vec3 direction, const char* what, std::uint32_t index, nook_result code) {
  if (!(std::abs(dot(direction, direction) - 1) <= 2e-3f))
    throw Failure(code, "%s %u is not a unit vector (got %g, %g, %g); normalise it", what, index,
                  double(direction.x), double(direction.y), double(direction.z));
}

void check_up(Vec3 up, nook_result code) {
  if (!(std::abs(dot(up, up) - 1) <= 2e-3f))
    throw Failure(code, "up, the hemisphere's axis, is not a unit vector (got %g, %g, %g); normalise it",
                  double(up.x), double(up.y), double(up.z));
}

void check_different(const Basis& basis, nook_result code) {
  const auto inner = [&](std::uint32_t i, std::uint32_t k) {
    return gaussian_product_integral(double(basis.sharpness[i]), double(basis.sharpness[k]),
                                     double(one_minus_cosine(basis.axis[i], basis.axis[k])));
  };
  for (std::uint32_t i = 0; i < basis.count; ++i)
    for (std::uint32_t k = 0; k < i; ++k)
      if (inner(i, k) > same_function * std::sqrt(inner(i, i) * inner(k, k)))
        throw Failure(code,
                      "%s %u (axis %g, %g, %g, sharpness %g) is the same function as lobe %u; leave one of "
                      "them out or move it",
                      lobe_name(basis, i), i, double(basis.axis[i].x), double(basis.axis[i].y),
                      double(basis.axis[i].z), double(basis.sharpness[i]), k);
}

void check_gaussians(const Basis& basis, nook_result code) {
  const std::uint32_t lobes = basis.count - (basis.ambient ? 1 : 0);
  if (basis.count > max_functions || lobes < 1)
    throw Failure(code, "the number of lobes is out of range (got %u, need 1 to %u with the ambient term)",
                  lobes, max_functions);
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    check_direction(basis.axis[i], "the axis of lobe", i, code);
    if (i == lobes && basis.sharpness[i] != 0)
      throw Failure(code, "the ambient term, lobe %u, has a sharpness (got %g, need 0)", i,
                    double(basis.sharpness[i]));
    if (i < lobes && !(basis.sharpness[i] > 0 && basis.sharpness[i] <= max_sharpness))
      throw Failure(code, "the sharpness of lobe %u is out of range (got %g, need above 0 to %g)", i,
                    double(basis.sharpness[i]), double(max_sharpness));
  }
  check_different(basis, code);
}

template <std::floating_point T>
void gaussian_values(const Basis& basis, const T direction[3], T* values) {
  for (std::uint32_t i = 0; i < basis.count; ++i) {
    const T x = direction[0] - T(basis.axis[i].x), y = direction[1] - T(basis.axis[i].y),
            z = direction[2] - T(basis.axis[i].z);
    values[i] = std::exp(T(-0.5) * T(basis.sharpness[i]) * (x * x + y * y + z * z));
  }
}

template <std::floating_point T>
void dice_values(const Basis& basis, const T direction[3], T* values) {
  for (std::uint32_t i = 0; i < basis.count; ++i)
    values[i] = dice_radiance(std::max(T(basis.axis[i].x) * direction[0] + T(basis.axis[i].y) * direction[1] +
                                           T(basis.axis[i].z) * direction[2],
                                       T(0)));
}

template <std::floating_point T>
void values_of(const Basis& basis, const T direction[3], T* values) {
  switch (basis.kind) {
    case BasisKind::gaussians:
      return gaussian_values(basis, direction, values);
    case BasisKind::harmonics:
      return evaluate_harmonics(basis.order, direction[0], direction[1], direction[2], values);
    case BasisKind::dice:
      return dice_values(basis, direction, values);
  }
}

}  // namespace

float even_sharpness(std::uint32_t lobes, Domain domain) {
  return std::min(float(lobes) * (domain == Domain::sphere ? 0.5f : 1.0f), max_sharpness);
}

Basis gaussian_basis(std::span<const Vec3> axes, std::span<const float> sharpnesses, bool ambient,
                     Domain domain, Vec3 up) {
  Basis basis;
  basis.domain = domain;
  basis.up = up;
  basis.ambient = ambient;
  const std::size_t lobes = std::min<std::size_t>(axes.size(), max_functions);
  std::copy_n(axes.begin(), lobes, basis.axis.begin());
  std::copy_n(sharpnesses.begin(), lobes, basis.sharpness.begin());
  if (ambient && lobes < max_functions) basis.axis[lobes] = up;
  basis.count = std::uint32_t(axes.size()) + (ambient ? 1 : 0);
  check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  for (std::size_t i = 0; i < lobes; ++i) basis.axis[i] = normalised(basis.axis[i]);
  basis.up = normalised(basis.up);
  return basis;
}

Basis vogel_basis(std::uint32_t lobes, bool ambient, Domain domain, Vec3 up) {
  std::array<Vec3, max_functions> axes;
  std::array<float, max_functions> sharpnesses;
  const std::uint32_t count = std::min(lobes, max_functions);
  if (domain == Domain::sphere)
    vogel_sphere(std::span(axes).first(count));
  else
    vogel_hemisphere(up, std::span(axes).first(count));
  sharpnesses.fill(even_sharpness(count, domain));
  return gaussian_basis(std::span(axes).first(count), std::span(sharpnesses).first(count), ambient, domain,
                        up);
}

Basis harmonic_basis(std::uint32_t order, Domain domain, Vec3 up) {
  Basis basis;
  basis.kind = BasisKind::harmonics;
  basis.domain = domain;
  basis.up = up;
  basis.order = order;
  basis.count = harmonic_count(std::min(order, max_order));
  check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  basis.up = normalised(basis.up);
  return basis;
}

Basis dice_basis(Domain domain, Vec3 up) {
  Basis basis;
  basis.kind = BasisKind::dice;
  basis.domain = domain;
  basis.up = up;
  basis.count = dice_vertices;
  std::copy(dice_axes.begin(), dice_axes.end(), basis.axis.begin());
  check_basis(basis, NOOK_ERROR_INVALID_ARGUMENT);
  basis.up = normalised(basis.up);
  return basis;
}

void check_basis(const Basis& basis, nook_result code) {
  check_up(basis.up, code);
  if (basis.kind == BasisKind::gaussians) check_gaussians(basis, code);
  if (basis.kind == BasisKind::harmonics)
    check_range("the order of the harmonics", basis.order, 1, max_order, code);
}

void evaluate_basis(const Basis& basis, Vec3 direction, float* values) {
  const float d[3] = {direction.x, direction.y, direction.z};
  values_of(basis, d, values);
}

void evaluate_basis(const Basis& basis, const double direction[3], double* values) {
  values_of(basis, direction, values);
}

double domain_area(Domain domain) {
  return (domain == Domain::sphere ? 4 : 2) * std::numbers::pi;
}

}  // namespace nook::probe
