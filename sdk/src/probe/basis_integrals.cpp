// Computes integrals of a basis over its domain, in closed form where one exists. Lobes that the horizon cuts
// are integrated by one-dimensional quadrature. The other kinds of basis functions are integrated by a
// product rule.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sdk/src/core/spherical_gaussian.h"
#include "sdk/src/probe/axes.h"
#include "sdk/src/probe/basis.h"
#include "sdk/src/probe/quadrature.h"

namespace nook::probe {
namespace {

constexpr double pi = std::numbers::pi;

constexpr GaussLegendre<64> rule;
// This rule is exact for products of two harmonics, which are polynomials of degree 2 max_order.
constexpr GaussLegendre<16> harmonics_rule;
static_assert(2 * max_order < 2 * std::tuple_size_v<decltype(harmonics_rule.node)>);

// Returns the integral of a lobe over a cap around its axis: 2 pi times the integral of e^(sharpness (t - 1))
// over t in [1 - depth, 1].
double cap_integral(double sharpness, double depth) {
  return 2 * pi * (sharpness < 1e-15 ? depth : -std::expm1(-sharpness * depth) / sharpness);
}

// Returns the integral of a lobe over a hemisphere. `cosine` is the cosine between the lobe's axis and the
// axis of the hemisphere. The function integrates over circles around the lobe's axis. From the axis
// outwards, the circles with angles up to |90 degrees - tilt| lie completely in the hemisphere. The horizon
// cuts the next circles. The last circles lie completely outside. For a lobe below the horizon, the order is
// reversed.
double hemisphere_integral(double sharpness, double cosine) {
  const double tilt = std::acos(std::clamp(cosine, -1.0, 1.0));
  const double first = std::abs(pi / 2 - tilt), last = pi - first;
  const double to_first = 1 - std::cos(first), to_last = 1 - std::cos(last);
  const double whole = cosine > 0 ? cap_integral(sharpness, to_first)
                                  : cap_integral(sharpness, 2) - cap_integral(sharpness, to_last);
  // Beyond this angle, the lobe is practically 0.
  const double depth = sharpness > 20 ? 40 / sharpness : 2;
  const double end = std::min(last, std::acos(1 - depth));
  if (!(end > first)) return whole;
  const double cotangent = cosine / std::max(std::sqrt(1 - cosine * cosine), 1e-300);
  // Substitutes angle = first + (end - first) (1 - cos u) / 2. At both ends of the interval, the length of
  // the arc above the horizon behaves like a square root. The substitution makes the integrand smooth there.
  const double cut = rule(0, pi, [&](double u) {
    const double angle = first + (end - first) * (1 - std::cos(u)) / 2;
    const double half_arc = std::acos(std::clamp(-cotangent / std::tan(angle), -1.0, 1.0));
    return 2 * half_arc * std::sin(angle) * std::exp(-sharpness * (1 - std::cos(angle))) * std::sin(u);
  });
  return whole + cut * (end - first) / 2;
}

double gaussian_inner(const Basis& basis, std::uint32_t i, std::uint32_t k) {
  const double a = basis.sharpness[i], b = basis.sharpness[k];
  const double apart = one_minus_cosine(basis.axis[i], basis.axis[k]);
  if (basis.domain == Domain::sphere) return gaussian_product_integral(a, b, apart);
  const ProductShape<double> shape = gaussian_product_shape(a, b, apart);
  const double along = a * double(dot(basis.axis[i], basis.up)) + b * double(dot(basis.axis[k], basis.up));
  return shape.scale *
         hemisphere_integral(shape.sharpness, shape.sharpness > 0 ? along / shape.sharpness : 1);
}

// Calls visit(values, weight) at the points of a product rule over the domain. The rule has N circles of 2 N
// points and is exact for polynomials of degree 2 N - 1.
template <int N, class Visit>
void over_circles(const GaussLegendre<N>& heights, const Basis& basis, Visit&& visit) {
  constexpr std::size_t azimuths = 2 * N;
  std::array<double, azimuths> cosine, sine;
  for (std::size_t k = 0; k < azimuths; ++k) {
    cosine[k] = std::cos(2 * pi * double(k) / azimuths);
    sine[k] = std::sin(2 * pi * double(k) / azimuths);
  }
  const Frame frame = frame_round(basis.domain == Domain::sphere ? Vec3{0, 0, 1} : basis.up);
  const double lowest = basis.domain == Domain::sphere ? -1 : 0;
  std::array<double, max_functions> values;
  for (std::size_t i = 0; i < heights.node.size(); ++i) {
    const double z = lowest + (1 - lowest) * (heights.node[i] + 1) / 2, r = std::sqrt(1 - z * z);
    const double weight = heights.weight[i] * (1 - lowest) / 2 * 2 * pi / azimuths;
    for (std::size_t k = 0; k < azimuths; ++k) {
      const double x = r * cosine[k], y = r * sine[k];
      const double direction[3] = {frame.x.x * x + frame.y.x * y + frame.z.x * z,
                                   frame.x.y * x + frame.y.y * y + frame.z.y * z,
                                   frame.x.z * x + frame.y.z * y + frame.z.z * z};
      evaluate_basis(basis, direction, values.data());
      visit(values.data(), weight);
    }
  }
}

// Integrates over the domain of the basis. The functions of ambient dice are not smooth, so they need many
// points.
template <class Visit>
void over_domain(const Basis& basis, Visit&& visit) {
  if (basis.kind == BasisKind::harmonics)
    over_circles(harmonics_rule, basis, visit);
  else
    over_circles(rule, basis, visit);
}

}  // namespace

Vector<double> basis_integrals(const Basis& basis, Memory* memory) {
  Vector<double> integrals(basis.count, memory);
  if (basis.kind == BasisKind::gaussians) {
    for (std::uint32_t i = 0; i < basis.count; ++i) {
      const double sharpness = basis.sharpness[i];
      integrals[i] = basis.domain == Domain::sphere
                         ? gaussian_integral(sharpness)
                         : hemisphere_integral(sharpness, double(dot(basis.axis[i], basis.up)));
    }
    return integrals;
  }
  over_domain(basis, [&](const double* values, double weight) {
    for (std::uint32_t i = 0; i < basis.count; ++i) integrals[i] += weight * values[i];
  });
  return integrals;
}

Vector<double> basis_gram(const Basis& basis, Memory* memory) {
  const std::size_t n = basis.count;
  Vector<double> gram(n * n, memory);
  if (basis.kind == BasisKind::gaussians) {
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t k = 0; k <= i; ++k) gram[i * n + k] = gram[k * n + i] = gaussian_inner(basis, i, k);
    return gram;
  }
  over_domain(basis, [&](const double* values, double weight) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k <= i; ++k) gram[i * n + k] += weight * values[i] * values[k];
  });
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) gram[k * n + i] = gram[i * n + k];
  return gram;
}

}  // namespace nook::probe
