#include "sdk/src/api/probe_lobes.h"
#include <nook/experimental/nook_sg.h>

#include <array>
#include <cmath>
#include <span>

#include "sdk/src/api/entry.h"
#include "sdk/src/core/checks.h"
#include "sdk/src/probe/basis.h"
#include "sdk/src/probe/harmonics.h"
#include "sdk/src/probe/probe.h"
#include "sdk/src/probe/probe_light.h"

using namespace nook;
using namespace nook::probe;

namespace {

void check_unit(Vec3 v, const char* what, std::size_t index) {
  if (!(std::abs(dot(v, v) - 1) <= 2e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s %zu is not a unit vector (got %g, %g, %g); normalise it",
                  what, index, double(v.x), double(v.y), double(v.z));
}

SphericalGaussian from_public(const nook_lobe& lobe, std::size_t index) {
  const SphericalGaussian g{{lobe.axis[0], lobe.axis[1], lobe.axis[2]},
                            lobe.sharpness,
                            {lobe.amplitude[0], lobe.amplitude[1], lobe.amplitude[2]}};
  check_unit(g.axis, "the axis of lobe", index);
  if (!(g.sharpness >= 0) || !std::isfinite(g.sharpness))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the sharpness of lobe %zu is out of range (got %g, need 0 or more)", index,
                  double(g.sharpness));
  for (const float channel : lobe.amplitude)
    if (!(std::abs(channel) <= max_coefficient))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the amplitude of lobe %zu is out of range (got %g, need at most %g)", index,
                    double(channel), double(max_coefficient));
  return g;
}

// Checks the caller's lobes, and stores a converted copy.
class Lobes {
 public:
  Lobes(const nook_lobe* lobes, std::uint32_t count) : count_(count) {
    check_range("lobe_count", count, 0, max_functions);
    if (count) need(lobes, "lobes");
    for (std::uint32_t i = 0; i < count; ++i) lobes_[i] = from_public(lobes[i], i);
  }
  std::span<const SphericalGaussian> get() const { return std::span(lobes_).first(count_); }

 private:
  std::array<SphericalGaussian, max_functions> lobes_;
  std::uint32_t count_;
};

void write_vec3(float* out, Vec3 v) {
  out[0] = v.x;
  out[1] = v.y;
  out[2] = v.z;
}

Surface surface_of(const nook_probe_surface& s, std::size_t index) {
  Surface surface{{s.normal[0], s.normal[1], s.normal[2]},
                  {s.view[0], s.view[1], s.view[2]},
                  {s.tangent[0], s.tangent[1], s.tangent[2]},
                  s.alpha_x,
                  s.alpha_y,
                  s.reflectance};
  check_unit(surface.normal, "the normal of surface", index);
  check_unit(surface.view, "the view of surface", index);
  if (s.alpha_x != s.alpha_y) check_unit(surface.tangent, "the tangent of surface", index);
  for (const float alpha : {s.alpha_x, s.alpha_y})
    if (!(alpha >= 0.001f && alpha <= 1))
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "alpha_x or alpha_y of surface %zu is out of range (got %g, need 0.001 to 1)", index,
                    double(alpha));
  if (!(s.reflectance >= 0 && s.reflectance <= 1))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the reflectance of surface %zu is out of range (got %g, need 0 to 1)", index,
                  double(s.reflectance));
  return surface;
}

IrradianceForm irradiance_form(nook_probe_irradiance_form form) {
  check_known("form", form, NOOK_PROBE_IRRADIANCE_BANDS);
  return static_cast<IrradianceForm>(form);
}

// Calls evaluate(lobes, direction) for each direction.
template <class Evaluate>
nook_result at_directions(const char* function, const nook_lobe* lobes, std::uint32_t lobe_count,
                          const float* directions, float* rgb, std::size_t count,
                          Evaluate&& evaluate) noexcept {
  return api::enter(function, [&] {
    const Lobes checked(lobes, lobe_count);
    if (count == 0) return;
    need(directions, "the array of directions");
    need(rgb, "the array for the answer");
    check_array("count", count, 3 * sizeof(float));
    for (std::size_t i = 0; i < count; ++i) {
      const float* d = directions + 3 * i;
      write_vec3(rgb + 3 * i, evaluate(checked.get(), Vec3{d[0], d[1], d[2]}));
    }
  });
}

// Calls body(a, b) with the two lobes that the caller passed.
template <class Body>
nook_result with_two(const char* function, const nook_lobe* a, const nook_lobe* b, const void* out,
                     Body&& body) noexcept {
  return api::enter(function, [&] {
    need(a, "a");
    need(b, "b");
    need(out, "the pointer for the answer");
    body(from_public(*a, 0), from_public(*b, 1));
  });
}

// Checks that the rows of a rotation are unit vectors and form a right-handed system.
void check_rotation(const float* m) {
  const Vec3 rows[3] = {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
  for (std::size_t i = 0; i < 3; ++i) check_unit(rows[i], "row", i);
  const Vec3 third = cross(rows[0], rows[1]) - rows[2];
  if (!(dot(third, third) <= 1e-5f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "rotation is not a rotation matrix: its rows are not at right angles to each other, or it "
                  "is mirrored; remove scale, shear and reflection");
}

}  // namespace

nook_result nook_sg_radiance(const nook_lobe* lobes, uint32_t lobe_count, const float* directions,
                             float* radiance_rgb, size_t count) {
  return at_directions("nook_sg_radiance", lobes, lobe_count, directions, radiance_rgb, count,
                       [](std::span<const SphericalGaussian> all, Vec3 d) { return radiance(all, d); });
}

nook_result nook_sg_irradiance(const nook_lobe* lobes, uint32_t lobe_count, nook_probe_irradiance_form form,
                               const float* normals, float* irradiance_rgb, size_t count) {
  return at_directions("nook_sg_irradiance", lobes, lobe_count, normals, irradiance_rgb, count,
                       [&](std::span<const SphericalGaussian> all, Vec3 n) {
                         return irradiance(all, irradiance_form(form), n);
                       });
}

nook_result nook_sg_specular(const nook_lobe* lobes, uint32_t lobe_count, nook_probe_specular_form form,
                             const nook_probe_surface* surfaces, float* rgb, size_t count) {
  return api::enter("nook_sg_specular", [&] {
    const Lobes checked(lobes, lobe_count);
    if (form != NOOK_PROBE_SPECULAR_ISOTROPIC && form != NOOK_PROBE_SPECULAR_ANISOTROPIC)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "form is unknown (got %d, need 0 or 1)", form);
    if (count == 0) return;
    need(surfaces, "surfaces");
    need(rgb, "rgb");
    check_array("count", count, sizeof(nook_probe_surface));
    // Checks all surfaces first, so that a failure writes nothing.
    for (std::size_t i = 0; i < count; ++i) surface_of(surfaces[i], i);
    for (std::size_t i = 0; i < count; ++i)
      write_vec3(rgb + 3 * i,
                 specular(checked.get(), static_cast<SpecularForm>(form), surface_of(surfaces[i], i)));
  });
}

nook_result nook_sg_integral(const nook_lobe* lobe, float rgb[3]) {
  return api::enter("nook_sg_integral", [&] {
    need(lobe, "lobe");
    need(rgb, "rgb");
    write_vec3(rgb, integral(from_public(*lobe, 0)));
  });
}

nook_result nook_sg_product(const nook_lobe* a, const nook_lobe* b, nook_lobe* out) {
  return with_two("nook_sg_product", a, b, out, [&](const SphericalGaussian& x, const SphericalGaussian& y) {
    *out = api::to_public(product(x, y));
  });
}

nook_result nook_sg_convolve(const nook_lobe* a, const nook_lobe* b, nook_lobe* out) {
  return with_two("nook_sg_convolve", a, b, out, [&](const SphericalGaussian& x, const SphericalGaussian& y) {
    *out = api::to_public(convolution(x, y));
  });
}

nook_result nook_sg_rotate(nook_lobe* lobes, uint32_t lobe_count, const float rotation[9]) {
  return api::enter("nook_sg_rotate", [&] {
    need(rotation, "rotation");
    check_rotation(rotation);
    const Lobes checked(lobes, lobe_count);
    const float* m = rotation;
    for (std::uint32_t i = 0; i < lobe_count; ++i) {
      const Vec3 a = checked.get()[i].axis;
      write_vec3(lobes[i].axis,
                 normalised({m[0] * a.x + m[1] * a.y + m[2] * a.z, m[3] * a.x + m[4] * a.y + m[5] * a.z,
                             m[6] * a.x + m[7] * a.y + m[8] * a.z}));
    }
  });
}

nook_result nook_sg_to_sh(const nook_lobe* lobes, uint32_t lobe_count, uint32_t order, float* coefficients) {
  return api::enter("nook_sg_to_sh", [&] {
    const Lobes checked(lobes, lobe_count);
    need(coefficients, "coefficients");
    check_range("order", order, 1, max_order);
    std::array<Vec3, harmonic_count(max_order)> projected;
    const std::span<Vec3> out = std::span(projected).first(harmonic_count(order));
    to_harmonics(checked.get(), order, out);
    for (const Vec3 v : out) {
      write_vec3(coefficients, v);
      coefficients += 3;
    }
  });
}
