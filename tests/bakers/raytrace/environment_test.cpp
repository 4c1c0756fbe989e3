// Environment maps: where their texels lie, and sampling by luminance against exact sums.
#include "bakers/raytrace/environment.h"

#include <cmath>
#include <numbers>

#include "bakers/raytrace/hemisphere.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

constexpr double pi = std::numbers::pi;

// Every texel another colour; one of them a sun.
Environment uneven_map() {
  std::vector<float> rgb;
  for (int i = 0; i < 16 * 8; ++i)
    for (int c = 0; c < 3; ++c) rgb.push_back(unit_float(mix_bits(std::uint64_t(3 * i + c))));
  for (int c = 0; c < 3; ++c) rgb[3 * 37 + c] = 500;
  for (int c = 0; c < 3; ++c) rgb[3 * 50 + c] = 0;
  return Environment(16, 8, rgb);
}

}  // namespace

TEST_CASE("texels lie where the header says and cover the sphere once") {
  const Environment map = uneven_map();
  double sphere = 0;
  for (std::uint32_t row = 0; row < 8; ++row) {
    sphere += 16 * map.solid_angle(row);
    for (std::uint32_t column = 0; column < 16; ++column)
      for (float inside : {0.01f, 0.5f, 0.99f})
        CHECK(map.texel_at(map.direction(column, row, inside, 1 - inside)) == row * 16 + column);
  }
  CHECK(std::abs(sphere - 4 * pi) < 1e-12);  // rounding of doubles
  CHECK(map.texel_at({0.1f, 1, 0}) / 16 == 0);
  CHECK(map.texel_at({0.1f, -1, 0}) / 16 == 7);
  CHECK(map.texel_at({1, 0.1f, 0.01f}) == 3 * 16 + 8);   // +x is the middle
  CHECK(map.texel_at({0.01f, 0.1f, 1}) == 3 * 16 + 11);  // +z a quarter to the right
  CHECK(map.texel_at({-1, 0.1f, -0.01f}) == 3 * 16);     // -x at the border
  for (Vec3 pole : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{-1, 0, 0}, Vec3{-1, 0, -0.0f}})
    CHECK(map.texel_at(pole) < map.texel_count());
}

TEST_CASE("samples by luminance integrate any function of the map without bias") {
  const Environment map = uneven_map();
  for (float uniform : {0.0f, 0.25f, 1.0f}) {
    const LightSampler sampler(map, uniform);
    Vec3 exact;
    double total_density = 0;
    for (std::uint32_t i = 0; i < map.texel_count(); ++i) {
      const double solid_angle = map.solid_angle(i / 16);
      exact += map.texel(i) * float(solid_angle);
      total_density += double(sampler.density(map.direction(i % 16, i / 16, 0.5f, 0.5f))) * solid_angle;
    }
    CHECK(std::abs(total_density - 1) < 1e-5);  // floats of densities
    constexpr int count = 200000;
    Vec3 mean;
    double sphere = 0;
    std::uint64_t key = 1;
    for (int i = 0; i < count; ++i) {
      const auto next = [&] { return unit_float(mix_bits(key++)); };
      const float choice = next(), alias = next(), u = next(), v = next();
      const LightSample s = sampler.sample(double(choice), alias, u, v);
      REQUIRE(s.density > 0);
      CHECK(s.radiance == map.radiance(s.direction));
      mean += s.radiance * (1 / (s.density * count));
      sphere += 1 / (double(s.density) * count);
    }
    // The sun holds 9/10 of the light: by luminance the standard error is below 0.2 %, uniformly it is
    // sqrt(1 / (200,000 * its share of the sphere, 0.9 %)) = 2.4 %.
    const float tolerance = uniform == 1 ? 0.08f : 0.006f;
    CHECK(std::abs(mean.x / exact.x - 1) < tolerance);
    CHECK(std::abs(mean.y / exact.y - 1) < tolerance);
    CHECK(std::abs(mean.z / exact.z - 1) < tolerance);
    // Black texels are never chosen by luminance alone, so that the samples lack a part of the sphere's own
    // area then.
    if (uniform > 0) CHECK(std::abs(sphere / (4 * pi) - 1) < 0.05);  // densities spread by 1e3: 1 % is usual
  }
}

TEST_CASE("a black map is sampled uniformly") {
  const Environment black(4, 2, std::vector<float>(24, 0.0f));
  const LightSampler sampler(black);
  CHECK(std::abs(double(sampler.sample(0.3, 0.4f, 0.5f, 0.6f).density) - 1 / (4 * pi)) < 1e-8);
}

TEST_CASE("maps that hold no light are refused") {
  CHECK_THROWS_AS(Environment(0, 4, {}), Failure);
  CHECK_THROWS_AS(Environment(2, 1, {1, 1, 1}), Failure);
  CHECK_THROWS_AS(Environment(1, 1, {1, -1, 1}), Failure);
  CHECK_THROWS_AS(Environment(1, 1, {1, std::nanf(""), 1}), Failure);
}
