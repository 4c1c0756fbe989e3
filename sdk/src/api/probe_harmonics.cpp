// The C functions for light that is given as spherical harmonics, in plain arrays of floats.
#include <nook/experimental/nook_sg.h>
#include <nook/nook_probe.h>

#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/entry.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/core/descriptors.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe_light.h"

using namespace nook;
using namespace nook::probe;

namespace {

using Coefficients = std::array<Vec3, harmonic_count(max_order)>;

// Copies `count` coefficients to `storage`, and returns them.
std::span<const Vec3> read_coefficients(const float* from, std::uint32_t count, Coefficients& storage) {
  need(from, "coefficients");
  for (std::uint32_t i = 0; i < count; ++i) {
    storage[i] = {from[3 * i], from[3 * i + 1], from[3 * i + 2]};
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(from[3 * i + std::uint32_t(c)]))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "coefficients[%u] is not finite (got %g)", i,
                      double(from[3 * i + std::uint32_t(c)]));
  }
  return std::span(storage).first(count);
}

void write_vec3(float* out, Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

// Calls evaluate(direction) for each direction.
template <class Evaluate>
void at_directions(const float* directions, float* rgb, std::size_t count, Evaluate&& evaluate) {
  if (count == 0) return;
  need(directions, "the array of directions");
  need(rgb, "the array for the answer");
  check_array("count", count, 3 * sizeof(float));
  for (std::size_t i = 0; i < count; ++i)
    write_vec3(rgb + 3 * i, evaluate(Vec3{directions[3 * i], directions[3 * i + 1], directions[3 * i + 2]}));
}

Basis basis_of_order(std::uint32_t order) {
  if (order < 1 || order > max_order)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "order is out of range (got %u, need 1 to %u, or NOOK_SH_ZH3)",
                  order, max_order);
  return harmonic_basis(order);
}

}  // namespace

nook_result nook_sh_radiance(const float* coefficients, uint32_t order, const float* directions, float* rgb,
                             size_t count) {
  return api::enter("nook_sh_radiance", [&] {
    Coefficients storage;
    if (order == NOOK_SH_ZH3) {
      const auto read = read_coefficients(coefficients, zonal_count, storage);
      at_directions(directions, rgb, count, [&](Vec3 direction) { return zonal_radiance(read, direction); });
      return;
    }
    const Basis basis = basis_of_order(order);
    const auto read = read_coefficients(coefficients, basis.count, storage);
    at_directions(directions, rgb, count, [&](Vec3 direction) { return radiance(basis, read, direction); });
  });
}

nook_result nook_sh_irradiance(const float* coefficients, uint32_t order, const float* normals, float* rgb,
                               size_t count) {
  return api::enter("nook_sh_irradiance", [&] {
    Coefficients storage;
    if (order == NOOK_SH_ZH3) {
      const auto read = read_coefficients(coefficients, zonal_count, storage);
      at_directions(normals, rgb, count, [&](Vec3 normal) { return zonal_irradiance(read, normal); });
      return;
    }
    const Basis basis = basis_of_order(order);
    const auto read = read_coefficients(coefficients, basis.count, storage);
    at_directions(normals, rgb, count,
                  [&](Vec3 normal) { return irradiance(basis, read, IrradianceForm::bands, normal); });
  });
}

nook_result nook_sh_to_zh3(const float* coefficients, float* zonal) {
  return api::enter("nook_sh_to_zh3", [&] {
    Coefficients storage;
    const auto read = read_coefficients(coefficients, harmonic_count(2), storage);
    need(zonal, "zonal");
    for (const Vec3 v : to_zonal(read)) {
      write_vec3(zonal, v);
      zonal += 3;
    }
  });
}
