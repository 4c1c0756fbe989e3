// Every instruction set against the formulas in double precision, on random and on extreme inputs.
#include "sdk/src/character/shadow_kernels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/catch.h"
#include "tests/character/kernel_reference.h"

using namespace nook;
using namespace nook::test;

namespace {

// The bound that shadow_kernels promises on a shadow, relative to shadows above 1: estimates with 14 bits in
// AVX-512 reach 6e-5 in each of two roots; everything else is below 1e-5.
constexpr double shadow_tolerance = 2e-4;

std::vector<float> shadows(const ShadowKernels& kernels, const SphereSoa& spheres, const KeyPointSoa& points,
                           const Kernel& kernel) {
  std::vector<float> shadow(points.padded_count, 0.0f);
  kernels.self_norm_sum(spheres, points, kernel, shadow.data());
  const std::vector<float> saturation(points.padded_count, 0.0f);
  kernels.norm_root(shadow.data(), saturation.data(), points.padded_count, kernel.gamma, shadow.data());
  return shadow;
}

double worst_shadow_error(const ShadowKernels& kernels, const SphereSoa& spheres, const KeyPointSoa& points,
                          std::uint32_t count, const Kernel& kernel) {
  const std::vector<float> shadow = shadows(kernels, spheres, points, kernel);
  double worst = 0;
  for (std::uint32_t k = 0; k < count; ++k) {
    const double truth = std::pow(reference_norm_sum(spheres, points, k, kernel), 1.0 / kernel.gamma);
    const double error = std::abs(shadow[k] - truth) / std::max(1.0, truth);
    worst = std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
  }
  return worst;
}

// One key point before spheres where formulas break first.
Spheres extreme_spheres() {
  Spheres spheres;
  for (const float radius : {1e-9f, 1e-6f, 1e-3f, 0.1f, 1.0f, 100.0f})
    for (const float distance : {0.0f, 0.5f, 1.0f, 1.0000001f, 2.0f, 1e4f})
      for (const Vec3 direction : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0.6f, 0.8f, 0}})
        spheres.add(direction * (radius * distance), radius);
  for (const float far : {1e3f, 1e6f, max_coordinate}) {
    spheres.add({0, far, 0}, 1e-9f);
    spheres.add({0, -far, 0}, 1);
    spheres.add({far, far, far}, 1e-3f);
  }
  return spheres;
}

}  // namespace

TEST_CASE("the scalar table is always there and the best table is one of the available") {
  REQUIRE(shadow_kernels(Isa::scalar) != nullptr);
  CHECK(shadow_kernels(Isa::scalar)->isa == Isa::scalar);
  const auto tables = available_kernels();
  CHECK(tables.back() == &best_shadow_kernels());
  CHECK(shadow_kernels(static_cast<Isa>(77)) == nullptr);
}

TEST_CASE("shadows follow the formulas on every instruction set") {
  std::mt19937 random(7);
  for (const ShadowKernels* kernels : available_kernels())
    for (const int sphere_count : {0, 1, 3, 130, 131})
      for (const int point_count : {1, 16, 17, 47, 100}) {
        const Spheres spheres = random_spheres(random, sphere_count);
        const Points points = random_points(random, point_count);
        for (const KernelForm form : {KernelForm::paper, KernelForm::nook, KernelForm::rational})
          for (const float gamma : {1.0f, 1.5f, 2.0f, 1.37f, 4.0f}) {
            INFO(kernels->name << " form " << int(form) << " gamma " << gamma << " spheres " << sphere_count);
            CHECK(worst_shadow_error(*kernels, spheres.view(), points.view(), points.count, {form, gamma}) <
                  shadow_tolerance);
          }
      }
}

TEST_CASE("shadows of single spheres at the extremes follow the formulas") {
  const Spheres all = extreme_spheres();
  Points points;
  points.add({0, 0, 0}, {0, 1, 0});
  for (const ShadowKernels* kernels : available_kernels())
    for (const KernelForm form : {KernelForm::paper, KernelForm::nook, KernelForm::rational})
      for (const float gamma : {1.0f, 1.5f, 2.0f, 3.3f})
        for (std::uint32_t i = 0; i < all.view().count; ++i) {
          SphereSoa one = all.view();
          one.x += i, one.y += i, one.z += i, one.inverse_radius += i, one.count = 1;
          INFO(kernels->name << " form " << int(form) << " gamma " << gamma << " sphere " << i);
          CHECK(worst_shadow_error(*kernels, one, points.view(), 1, {form, gamma}) < shadow_tolerance);
        }
}

TEST_CASE("two calls join their spheres in one norm") {
  std::mt19937 random(8);
  const Spheres spheres = random_spheres(random, 20);
  const Points points = random_points(random, 30);
  SphereSoa first = spheres.view(), second = first;
  first.count = 7;
  second.x += 7, second.y += 7, second.z += 7, second.inverse_radius += 7, second.count = 13;
  for (const ShadowKernels* kernels : available_kernels()) {
    std::vector<float> whole(points.padded(), 0.0f), parts = whole;
    kernels->self_norm_sum(spheres.view(), points.view(), {}, whole.data());
    kernels->self_norm_sum(first, points.view(), {}, parts.data());
    kernels->self_norm_sum(second, points.view(), {}, parts.data());
    CHECK(whole == parts);  // the same additions in the same order
  }
}

TEST_CASE("the general power is good to 1e-5 of its value") {
  std::vector<float> sum(1024), saturation(1024, 0.0f), root(1024);
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] = static_cast<float>(std::pow(10.0, -6 + 9.0 * double(i) / 1023));
  for (const ShadowKernels* kernels : available_kernels())
    for (const float gamma : {0.25f, 0.4f, 1.0f, 1.37f, 1.5f, 2.0f, 3.0f, 8.0f}) {  // exponents 4 to 1/8
      kernels->norm_root(sum.data(), saturation.data(), 1024, gamma, root.data());
      double worst = 0;
      for (std::size_t i = 0; i < sum.size(); ++i)
        worst = std::max(worst, std::abs(root[i] / std::pow(double(sum[i]), 1 / double(gamma)) - 1));
      INFO(kernels->name << " gamma " << gamma);
      CHECK(worst < 1e-5);
    }
}

TEST_CASE("a saturated shadow is n / (1 + c n) of its norm, and 1 / c in the limit") {
  std::vector<float> sum(1024), saturation(1024), shadow(1024);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i] = static_cast<float>(std::pow(10.0, -6 + 12.0 * double(i) / 1023));
    saturation[i] = std::vector<float>{0, 0.01f, 0.5f, 3, 64}[i % 5];
  }
  for (const ShadowKernels* kernels : available_kernels())
    for (const float gamma : {1.0f, 2.0f}) {
      kernels->norm_root(sum.data(), saturation.data(), 1024, gamma, shadow.data());
      double worst = 0;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        const double norm = std::pow(double(sum[i]), 1 / double(gamma));
        worst = std::max(worst, std::abs(shadow[i] * (1 + double(saturation[i]) * norm) / norm - 1));
      }
      INFO(kernels->name << " gamma " << gamma);
      CHECK(worst < 1e-6);  // a square root, a product, a sum and a quotient, each rounded once
    }
}

TEST_CASE("the root of nothing is nothing") {
  std::vector<float> sum(16, 0.0f), saturation(16, 2.0f), root(16, 1.0f);
  for (const ShadowKernels* kernels : available_kernels())
    for (const float gamma : {1.0f, 1.5f, 2.0f, 3.3f}) {
      kernels->norm_root(sum.data(), saturation.data(), 16, gamma, root.data());
      CHECK(std::all_of(root.begin(), root.end(), [](float r) { return r == 0; }));
    }
}

TEST_CASE("composed depth adds weighted fast form factors") {
  std::mt19937 random(9);
  for (const ShadowKernels* kernels : available_kernels())
    for (const int sphere_count : {1, 3, 131}) {
      const Spheres spheres = random_spheres(random, sphere_count);
      const Points points = random_points(random, 47);
      std::vector<float> depth(points.padded(), 0.25f);
      kernels->composed_depth(spheres.view(), points.view(), depth.data());
      for (std::uint32_t k = 0; k < points.count; ++k) {
        double sum = 0;
        for (std::uint32_t i = 0; i < spheres.view().count; ++i) {
          const View v = view_of(spheres.view(), i, points.view(), k);
          sum += spheres.weight[i] * form_factor_fast(v.xi, v.delta2);
        }
        const double truth = 0.25 + solid_depth(sum);
        INFO(kernels->name << " spheres " << sphere_count);
        // On a sphere's surface the fast form has a root of h - 1: a rounding of 1e-7 there becomes 3e-4.
        CHECK(std::abs(depth[k] - truth) < 3e-4 * std::max(1.0, truth));
      }
    }
}

TEST_CASE("free occluders multiply what they leave open, by the exact form factor") {
  std::mt19937 random(10);
  for (const ShadowKernels* kernels : available_kernels())
    for (const bool weighted : {false, true}) {
      Spheres spheres = random_spheres(random, 5);
      spheres.add({0, -101, 0}, 100, 0.5f);  // the ground
      const Points points = random_points(random, 47);
      SphereSoa view = spheres.view();
      if (!weighted) view.caster_weight = nullptr;
      std::vector<float> open(points.padded(), 0.5f);
      kernels->exact_open(view, points.view(), open.data());
      for (std::uint32_t k = 0; k < points.count; ++k) {
        double truth = 0.5;
        for (std::uint32_t i = 0; i < view.count; ++i) {
          const View v = view_of(view, i, points.view(), k);
          truth *=
              1 - std::min(1.0, (weighted ? spheres.weight[i] : 1.0f) * form_factor_exact(v.xi, v.delta2));
        }
        INFO(kernels->name);
        // 1 m above a ground of 100 m, h^2 - 1 = 0.02 has a rounding of 1e-7, which its root turns into 1e-6
        // and the arc cosine near 1 into less than 1e-4.
        CHECK(std::abs(open[k] - truth) < 1e-4);
      }
    }
}

TEST_CASE("composed terms stay finite and in range at the extremes") {
  const Spheres spheres = extreme_spheres();
  Points points;
  points.add({0, 0, 0}, {0, 1, 0});
  points.add({0, 0, 0}, {0, 0, 0});
  for (const ShadowKernels* kernels : available_kernels())
    for (std::uint32_t i = 0; i < spheres.view().count; ++i) {
      SphereSoa one = spheres.view();
      one.x += i, one.y += i, one.z += i, one.inverse_radius += i, one.caster_weight += i, one.count = 1;
      std::vector<float> depth(16, 0.0f), open(16, 1.0f), occlusion(16, -1.0f);
      kernels->composed_depth(one, points.view(), depth.data());
      kernels->exact_open(one, points.view(), open.data());
      kernels->composed_occlusion(depth.data(), open.data(), 16, occlusion.data());
      for (int k = 0; k < 2; ++k) {
        INFO(kernels->name << " sphere " << i << " point " << k);
        // Rounding of the polynomials and estimates can pass the ends of the range by about 1e-6.
        CHECK((depth[k] >= 0 && depth[k] <= solid_depth(1.00001f)));
        CHECK((open[k] >= -1e-5f && open[k] <= 1.00001f));
        CHECK((occlusion[k] >= -1e-5f && occlusion[k] <= 1.00001f));
      }
    }
}

TEST_CASE("composed occlusion joins depth and what is open") {
  std::vector<float> depth(32), open(32), occlusion(32);
  for (std::size_t k = 0; k < depth.size(); ++k) depth[k] = 0.2f * float(k), open[k] = 1 - float(k) / 40;
  for (const ShadowKernels* kernels : available_kernels()) {
    kernels->composed_occlusion(depth.data(), open.data(), 32, occlusion.data());
    for (std::size_t k = 0; k < depth.size(); ++k)
      CHECK(std::abs(occlusion[k] - (1 - open[k] * std::exp(-double(depth[k])))) < 1e-6);
    kernels->composed_occlusion(nullptr, open.data(), 32, occlusion.data());
    CHECK(std::abs(occlusion[9] - 9.0f / 40) < 1e-6);
    kernels->composed_occlusion(depth.data(), nullptr, 32, occlusion.data());
    CHECK(std::abs(occlusion[9] - (1 - std::exp(-1.8))) < 1e-6);
  }
}
