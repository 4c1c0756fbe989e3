// The warped lobes against the GGX reflection integral they stand for.
#include "probe/specular.h"

#include "catch.h"
#include "probe/axes.h"
#include "samples.h"
#include "sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;

namespace {

constexpr double pi = std::numbers::pi;

double ggx(const Surface& s, Vec3 half, Vec3 bitangent) {
  const double x = double(dot(half, s.tangent)) / double(s.alpha_x);
  const double y = double(dot(half, bitangent)) / double(s.alpha_y), z = double(dot(half, s.normal));
  const double sum = x * x + y * y + z * z;
  return z > 0 ? 1 / (pi * double(s.alpha_x) * double(s.alpha_y) * sum * sum) : 0;
}

double masking(const Surface& s, Vec3 d, Vec3 bitangent) {
  const double n = double(dot(d, s.normal)), x = double(dot(d, s.tangent) * s.alpha_x),
               y = double(dot(d, bitangent) * s.alpha_y);
  return 1 / (n + std::sqrt(n * n + x * x + y * y));
}

// Radiance towards the eye by brute force round the mirror direction; channel x.
double reflected(const Surface& s, std::span<const SphericalGaussian> lights) {
  const Vec3 mirror = s.normal * (2 * dot(s.normal, s.view)) - s.view, bitangent = cross(s.normal, s.tangent);
  const Frame frame = frame_round(mirror);
  const auto integrand = [&](double x, double y, double z) {
    const Vec3 l = frame.x * float(x) + frame.y * float(y) + frame.z * float(z);
    const double cosine = double(dot(l, s.normal));
    if (cosine <= 0) return 0.0;
    const Vec3 half = normalised(l + s.view);
    const double away = 1 - double(dot(half, s.view));
    const double fresnel = double(s.reflectance) + (1 - double(s.reflectance)) * std::pow(away, 5);
    double light = 0;
    for (const SphericalGaussian& g : lights) light += double(value(g, l).x);
    return light * ggx(s, half, bitangent) * masking(s, l, bitangent) * masking(s, s.view, bitangent) *
           fresnel * cosine;
  };
  // Fine steps near the mirror direction, where a glossy lobe lives.
  return test::integrate_sphere(integrand, 0, 0.4, 200, 90) +
         test::integrate_sphere(integrand, 0.4, pi, 200, 90);
}

Surface surface(float alpha_x, float alpha_y, double view_angle, double azimuth = 0.4) {
  Surface s;
  s.alpha_x = alpha_x;
  s.alpha_y = alpha_y;
  s.view = {float(std::sin(view_angle) * std::cos(azimuth)), float(std::sin(view_angle) * std::sin(azimuth)),
            float(std::cos(view_angle))};
  s.reflectance = 0.3f;
  return s;
}

std::vector<SphericalGaussian> lights() {
  std::vector<SphericalGaussian> all{{{0, 0, 1}, 0, {0.3f, 0.3f, 0.3f}}};
  const Basis basis = vogel_basis(12);
  for (std::uint32_t i = 0; i < 12; ++i)
    all.push_back(
        {basis.axis[i], basis.sharpness[i], Vec3{1, 1, 1} * (0.5f + 0.4f * std::sin(2.0f * float(i)))});
  return all;
}

// The largest relative errors of both forms over views up to 60 degrees.
struct Worst {
  double isotropic = 0, anisotropic = 0;
};

Worst worst_of(float alpha_x, float alpha_y, double last_angle) {
  const auto all = lights();
  Worst worst;
  for (const double angle : {0.0, 0.3, 0.6, 0.8, 1.0, 1.2, 1.4}) {
    if (angle > last_angle) break;
    for (const double azimuth : {0.4, 2.0}) {
      const Surface s = surface(alpha_x, alpha_y, angle, azimuth);
      const double truth = reflected(s, all);
      worst.isotropic = std::max(worst.isotropic,
                                 std::abs(double(specular(all, SpecularForm::isotropic, s).x) / truth - 1));
      worst.anisotropic = std::max(
          worst.anisotropic, std::abs(double(specular(all, SpecularForm::anisotropic, s).x) / truth - 1));
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("glossy reflection of a probe against the GGX integral") {
  // What one lobe leaves of a distribution with GGX's tails: little while the light is broader than it. The
  // anisotropic lobe is nearer until the tails are all that is missing.
  const struct {
    float alpha;
    double isotropic, anisotropic;
  } bounds[] = {{0.05f, 0.02, 0.02}, {0.1f, 0.04, 0.03}, {0.2f, 0.12, 0.08}, {0.4f, 0.3, 0.3}};
  for (const auto& bound : bounds) {
    const Worst worst = worst_of(bound.alpha, bound.alpha, 1.05);
    INFO("alpha " << bound.alpha << " isotropic " << worst.isotropic << " anisotropic " << worst.anisotropic);
    CHECK(worst.isotropic < bound.isotropic);
    CHECK(worst.anisotropic < bound.anisotropic);
  }
}

TEST_CASE("anisotropic surfaces against the GGX integral") {
  for (const auto& [x, y] : {std::pair{0.1f, 0.3f}, {0.4f, 0.1f}}) {
    const Worst worst = worst_of(x, y, 1.05);
    INFO("alpha " << x << " " << y << " isotropic " << worst.isotropic << " anisotropic "
                  << worst.anisotropic);
    CHECK(worst.anisotropic < 0.18);
    CHECK(worst.anisotropic < worst.isotropic + 0.02);
  }
}

TEST_CASE("the anisotropic lobe of an isotropic one is a spherical Gaussian") {
  // Seen straight on, both warps agree.
  const Surface s = surface(0.2f, 0.2f, 0);
  for (const SphericalGaussian& light : lights()) {
    const float a = product_integral(warped_lobe(s), light).x;
    const float b = product_integral(warped_anisotropic_lobe(s), light) * light.amplitude.x;
    CHECK(std::abs(a - b) < 1e-4f * std::abs(a));
  }
}

TEST_CASE("reflection turns with its tangent and is finite everywhere") {
  const auto all = lights();
  for (const float alpha : {0.001f, 0.03f, 1.0f})
    for (const double angle : {0.0, 1.0, pi / 2, 2.0}) {
      const Surface s = surface(alpha, 0.5f, angle);
      for (const SpecularForm form : {SpecularForm::isotropic, SpecularForm::anisotropic}) {
        const Vec3 rgb = specular(all, form, s);
        CHECK((std::isfinite(rgb.x) && rgb.x >= 0));
      }
      // Widths and tangent exchanged: the same surface.
      Surface turned = s;
      std::swap(turned.alpha_x, turned.alpha_y);
      turned.tangent = {0, 1, 0};
      const Vec3 a = specular(all, SpecularForm::anisotropic, s);
      const Vec3 b = specular(all, SpecularForm::anisotropic, turned);
      CHECK(length(a - b) <= 1e-3f * length(a));
    }
}
