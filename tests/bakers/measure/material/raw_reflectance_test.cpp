#include "bakers/measure/material/raw_reflectance.h"

#include <cmath>

#include "bakers/material/raw_material.h"
#include "sdk/src/material/parabolic.h"
#include "tests/bakers/material/small_material.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;
namespace nm = nook::material;

namespace {

constexpr std::uint32_t width = 8, height = 4;

// The value of a light, channel, view and texel: linear in the view's place in the parabolic map, which the
// spline reproduces.
float value_of(std::size_t row, nm::ParabolicPoint view, std::size_t texel) {
  return 1 + 0.1f * float(row) + 0.8f * view.x * std::sin(float(texel)) + 0.5f * view.y;
}

RawMaterial linear_material() {
  RawMaterial raw = test::small_material(7, 24, width, height);
  raw.lights = spiral_directions(7);
  raw.views = spiral_directions(24);
  std::size_t at = 0;
  for (std::size_t row = 0; row < raw.light_rows(); ++row)
    for (const Vec3 view : raw.views)
      for (std::size_t texel = 0; texel < raw.texels(); ++texel)
        raw.btf[at++] = value_of(row, nm::to_parabolic(view), texel);
  return raw;
}

}  // namespace

TEST_CASE("raw reflectance is the raw material at its lights and texels, for any view") {
  const RawMaterial raw = linear_material();
  const measure::RawReflectance reflectance(raw);
  REQUIRE(reflectance.number_count() == 21);
  std::vector<float> numbers(21);
  for (int i = 0; i < 9; ++i) {
    nm::Sample sample;
    const std::uint32_t x = std::uint32_t(i) % width, y = std::uint32_t(i) % height;
    sample.u = (float(x) + 0.5f) / width + float(i);  // the tile repeats
    sample.v = (float(y) + 0.5f) / height;
    const nm::ParabolicPoint p{0.35f * std::cos(float(i)), 0.35f * std::sin(2.0f * float(i))};
    sample.view = nm::from_parabolic(p);
    reflectance.decode(sample, numbers);
    for (std::size_t light = 0; light < raw.lights.size(); ++light) {
      const Vec3 at = reflectance.radiance(numbers, raw.lights[light]);
      // A cell of the map is 1/256 wide, by which values change by up to 0.004.
      CHECK(at.x == Approx(value_of(3 * light, p, y * width + x)).margin(0.006));
      CHECK(at.z == Approx(value_of(3 * light + 2, p, y * width + x)).margin(0.006));
    }
    CHECK(reflectance.radiance(numbers, normalised({0.3f, 0, -0.1f})).x == 0);
  }
}

TEST_CASE("raw reflectance of a distant surface is the mean of its texels") {
  const RawMaterial raw = linear_material();
  const measure::RawReflectance reflectance(raw);
  std::vector<float> numbers(21);
  nm::Sample sample;
  sample.u = 0.3f;
  sample.v = 0.7f;
  sample.level = 10;
  sample.view = raw.views[5];
  reflectance.decode(sample, numbers);
  // 8 x 4 texels end at 2 x 1, between which the pixel mixes: near the middle of both halves both count.
  const nm::ParabolicPoint p = nm::to_parabolic(raw.views[5]);
  double half[2]{};
  for (std::size_t y = 0; y < height; ++y)
    for (std::size_t x = 0; x < width; ++x) half[x / 4] += double(value_of(4, p, y * width + x)) / 16;
  const double t = 0.3 * 2 - 0.5;
  CHECK(double(numbers[4]) == Approx(half[0] * (1 - t) + half[1] * t).margin(0.006));
}
