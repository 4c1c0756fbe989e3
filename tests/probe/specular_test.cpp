// Glossy reflection against the GGX reflection integral that it stands for.
#include "sdk/src/probe/probe_light.h"

#include "bakers/measure/probe/visible_reflections.h"
#include "sdk/src/probe/axes.h"
#include "tests/catch.h"
#include "tests/probe/samples.h"
#include "tests/probe/sphere_quadrature.h"

using namespace nook;
using namespace nook::probe;

namespace {

constexpr double pi = std::numbers::pi;

// Seen from `facing`, the cosine to the normal.
Surface surface(float alpha_x, float alpha_y, double facing, double azimuth = 0.4) {
  Surface s;
  s.alpha_x = alpha_x;
  s.alpha_y = alpha_y;
  const double sine = std::sqrt(1 - facing * facing);
  s.view = {float(sine * std::cos(azimuth)), float(sine * std::sin(azimuth)), float(facing)};
  s.reflectance = 0.3f;
  return s;
}

// 12 lobes whose amplitudes differ by up to 1 : 9, and no constant term, under which every relative error is
// smaller.
std::vector<SphericalGaussian> lights() {
  std::vector<SphericalGaussian> all;
  const Basis basis = vogel_basis(12);
  for (std::uint32_t i = 0; i < 12; ++i)
    all.push_back(
        {basis.axis[i], basis.sharpness[i], Vec3{1, 1, 1} * (0.5f + 0.4f * std::sin(2.0f * float(i)))});
  return all;
}

// Radiance towards the eye; channel x.
double reflected(const Surface& s, std::span<const SphericalGaussian> lights, int steps = 96) {
  const Vec3 bitangent = cross(s.normal, s.tangent);
  double sum = 0;
  for (const measure::ReflectedDirection& l : measure::visible_reflections(s, steps)) {
    const Vec3 d = s.tangent * float(l.x) + bitangent * float(l.y) + s.normal * float(l.z);
    double light = 0;
    for (const SphericalGaussian& g : lights) light += double(value(g, d).x);
    sum += light * l.weight * (double(s.reflectance) + (1 - double(s.reflectance)) * l.schlick);
  }
  return sum;
}

double relative_error(const Surface& s, std::span<const SphericalGaussian> lights, SpecularForm form,
                      double truth) {
  return std::abs(double(specular(lights, form, s).x) / truth - 1);
}

constexpr double facings[] = {0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1};

// Relative errors of both forms under 12 lobes, over views.
struct Errors {
  double isotropic = 0, anisotropic = 0;  // the largest
  double isotropic_square = 0, anisotropic_square = 0;

  void add(const Surface& s, std::span<const SphericalGaussian> all) {
    const double truth = reflected(s, all);
    const double i = relative_error(s, all, SpecularForm::isotropic, truth);
    const double a = relative_error(s, all, SpecularForm::anisotropic, truth);
    isotropic = std::max(isotropic, i);
    anisotropic = std::max(anisotropic, a);
    isotropic_square += i * i;
    anisotropic_square += a * a;
  }
};

Errors errors_of(float alpha_x, float alpha_y) {
  const auto all = lights();
  Errors errors;
  for (const double facing : facings)
    for (const double azimuth : {0.4, 2.0, 4.0}) errors.add(surface(alpha_x, alpha_y, facing, azimuth), all);
  return errors;
}

}  // namespace

TEST_CASE("the sum over visible normals is the GGX integral over directions") {
  const Surface s = surface(0.3f, 0.5f, 0.6);
  const auto all = lights();
  const Vec3 bitangent = cross(s.normal, s.tangent);
  const auto hidden = [&](Vec3 d) {
    const double n = double(dot(d, s.normal)), x = double(dot(d, s.tangent) * s.alpha_x),
                 y = double(dot(d, bitangent) * s.alpha_y);
    return std::hypot(n, x, y);
  };
  const double direct = test::integrate_hemisphere([&](double x, double y, double z) {
    const Vec3 l{float(x), float(y), float(z)}, half = normalised(l + s.view);
    const double hx = double(dot(half, s.tangent) / s.alpha_x), hy = double(dot(half, bitangent) / s.alpha_y);
    const double sum = hx * hx + hy * hy + double(half.z) * double(half.z);
    const double distribution = 1 / (pi * double(s.alpha_x) * double(s.alpha_y) * sum * sum);
    const double fresnel = 0.3 + 0.7 * std::pow(1 - double(dot(half, s.view)), 5);
    double light = 0;
    for (const SphericalGaussian& g : all) light += double(value(g, l).x);
    // The masking of both directions over 4 times both cosines.
    const double eye = double(dot(s.view, s.normal)), both = 0.5 / (eye * hidden(l) + z * hidden(s.view));
    return light * distribution * both * fresnel * z;
  });
  // Both are grids of some 10,000 points.
  CHECK(std::abs(reflected(s, all) / direct - 1) < 2e-3);
}

TEST_CASE("under constant light a surface reflects its directional albedo") {
  const std::vector<SphericalGaussian> constant{{{0, 0, 1}, 0, {1, 1, 1}}};
  for (const float alpha : {0.005f, 0.02f, 0.05f, 0.1f, 0.2f, 0.3f, 0.5f, 0.7f, 1.0f})
    for (const double facing : facings)
      for (const float reflectance : {0.02f, 0.04f, 0.3f, 1.0f}) {
        Surface s = surface(alpha, alpha, facing);
        s.reflectance = reflectance;
        const double truth = reflected(s, constant);
        INFO("alpha " << alpha << " facing " << facing << " reflectance " << reflectance);
        // The error that 15 coefficients for masking and 15 for Fresnel leave, see ggx_fit.cpp.
        CHECK(relative_error(s, constant, SpecularForm::isotropic, truth) < 0.05);
        CHECK(relative_error(s, constant, SpecularForm::anisotropic, truth) < 0.05);
      }
}

TEST_CASE("under constant light anisotropic surfaces reflect their directional albedo") {
  const std::vector<SphericalGaussian> constant{{{0, 0, 1}, 0, {1, 1, 1}}};
  // Metals are masked alone; of plastic at grazing views most is Fresnel's part, whose mean angle depends on
  // both widths in ways that one width does not hold.
  const struct {
    float reflectance;
    double worst, rms;
  } bounds[] = {{1, 0.05, 0.02}, {0.5f, 0.065, 0.02}, {0.04f, 0.2, 0.06}};
  for (const auto& bound : bounds) {
    double worst = 0, square = 0;
    int count = 0;
    for (const auto& [x, y] :
         {std::pair{0.1f, 0.3f}, {0.1f, 0.6f}, {0.2f, 0.8f}, {0.5f, 1.0f}, {0.05f, 0.2f}})
      for (const double facing : facings)
        for (const double azimuth : {0.0, 0.4, 0.8, 1.2, pi / 2}) {
          Surface s = surface(x, y, facing, azimuth);
          s.reflectance = bound.reflectance;
          const double error = relative_error(s, constant, SpecularForm::anisotropic, reflected(s, constant));
          worst = std::max(worst, error);
          square += error * error;
          ++count;
        }
    INFO("reflectance " << bound.reflectance << " worst " << worst << " rms " << std::sqrt(square / count));
    CHECK(worst < bound.worst);
    CHECK(std::sqrt(square / count) < bound.rms);
  }
}

TEST_CASE("glossy reflection of a probe against the GGX integral") {
  // From any view, 0.02 to 1. What one lobe, and four, leave of a distribution with GGX's tails and a
  // horizon.
  const struct {
    float alpha;
    double isotropic, anisotropic;
  } bounds[] = {{0.05f, 0.075, 0.07}, {0.1f, 0.035, 0.095}, {0.2f, 0.125, 0.09},
                {0.4f, 0.115, 0.09},  {0.7f, 0.065, 0.055}, {1, 0.035, 0.065}};
  for (const auto& bound : bounds) {
    const Errors errors = errors_of(bound.alpha, bound.alpha);
    INFO("alpha " << bound.alpha << " isotropic " << errors.isotropic << " anisotropic "
                  << errors.anisotropic);
    CHECK(errors.isotropic < bound.isotropic);
    CHECK(errors.anisotropic < bound.anisotropic);
  }
}

TEST_CASE("anisotropic surfaces against the GGX integral") {
  for (const auto& [x, y] : {std::pair{0.1f, 0.3f}, {0.4f, 0.1f}, {0.2f, 0.8f}}) {
    const Errors errors = errors_of(x, y);
    INFO("alpha " << x << " " << y << " isotropic " << errors.isotropic << " anisotropic "
                  << errors.anisotropic);
    CHECK(errors.anisotropic < 0.14);
    // One lobe is equally wide in all directions.
    CHECK(errors.anisotropic_square < 0.1 * errors.isotropic_square);
  }
}

TEST_CASE("glossy reflection of light from one side") {
  // One lobe is 20 times as bright as the others: most reflections are dim, and relative errors large.
  std::vector<SphericalGaussian> one = lights();
  for (std::size_t i = 0; i < one.size(); ++i) one[i].amplitude = Vec3{1, 1, 1} * (i == 4 ? 2.0f : 0.1f);
  for (const float alpha : {0.05f, 0.1f, 0.2f, 0.4f, 0.7f, 1.0f}) {
    Errors errors;
    for (const double facing : facings)
      for (const double azimuth : {0.4, 2.0, 4.0}) errors.add(surface(alpha, alpha, facing, azimuth), one);
    INFO("alpha " << alpha << " isotropic " << errors.isotropic << " anisotropic " << errors.anisotropic);
    CHECK(errors.isotropic < 0.4);
    CHECK(errors.anisotropic < 0.4);
  }
}

TEST_CASE("a rough metal sphere has no rim") {
  // From the middle of a sphere to its silhouette, under constant light and under one lobe behind the eye.
  const std::vector<SphericalGaussian> constant{{{0, 0, 1}, 0, {1, 1, 1}}};
  for (const float alpha : {0.2f, 0.4f, 0.7f, 1.0f}) {
    Surface s;
    s.alpha_x = s.alpha_y = alpha;
    s.reflectance = 0.92f;
    s.view = {0, 0, 1};
    float before = 0;
    for (int i = 0; i <= 98; ++i) {
      const float facing = 1 - float(i) / 100;
      s.normal = {std::sqrt(1 - facing * facing), 0, facing};
      s.tangent = {0, 1, 0};
      const float now = specular(constant, SpecularForm::anisotropic, s).x;
      INFO("alpha " << alpha << " facing " << facing);
      // Single scattering grows towards the silhouette for these widths, or falls by a few percent (0.2).
      if (i > 0) CHECK(now > 0.985f * before);
      before = now;
    }
  }
}

TEST_CASE("lobes of a narrow surface are the mirror direction") {
  // The lobes' integrals add up to 1, and far from the lobes a light is as if they were one point.
  const SphericalGaussian light{{0, 0, 1}, 3, {1, 1, 1}};
  for (const double facing : {0.3, 0.6, 1.0}) {
    const Surface s = surface(0.002f, 0.002f, facing);
    const Vec3 mirrored{-s.view.x, -s.view.y, s.view.z};
    float one = product_integral(reflected_lobe(s), light).x, four = 0, whole = 0;
    for (const SphericalGaussian& lobe : reflected_lobes(s)) {
      four += product_integral(lobe, light).x;
      whole += integral(lobe).x;
    }
    const float truth = value(light, mirrored).x;
    CHECK(std::abs(whole - 1) < 1e-5f);
    // GGX's tails reach 10 widths and more.
    CHECK(std::abs(one - truth) < 0.01f);
    CHECK(std::abs(four - truth) < 0.01f);
  }
}

TEST_CASE("reflection turns with its tangent and is finite everywhere") {
  const auto all = lights();
  for (const float alpha : {0.001f, 0.03f, 1.0f})
    for (const double angle : {0.0, 1.0, pi / 2, 2.0}) {
      Surface s = surface(alpha, 0.5f, 1);
      s.view = {float(std::sin(angle) * std::cos(0.4)), float(std::sin(angle) * std::sin(0.4)),
                float(std::cos(angle))};
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
      // Straight on the plane of incidence is the tangent's, along which two of the four normals lie.
      CHECK(length(a - b) <= (angle == 0 ? 1e-2f : 1e-3f) * length(a));
    }
}
