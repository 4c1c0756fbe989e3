#include "sdk/src/world/coverage.h"

#include <cmath>
#include <limits>

#include "tests/catch.h"
#include "tests/character/model_sample.h"
#include "tests/world/directions.h"

using namespace nook;
using namespace nook::test;

namespace {

// The arc cosine is within 7e-5 and enters three times, weighted by less than 1 / pi.
constexpr double rounding = 1e-4;

Capsule sphere(Vec3 centre, float radius) {
  return {centre, centre, radius, radius};
}

// The closed form of a sphere that the horizon clips, in double precision: radius r, distance h, height of
// the centre z, all in metres (Snyder 1996, in the form of the integral over the clipped disc).
double clipped_sphere(double z, double h, double r) {
  const double xi = z / r, k = h / r;
  if (xi >= 1) return xi / (k * k * k);
  if (xi <= -1) return 0;
  const double c = std::sqrt((k * k - 1) / (k * k - xi * xi));
  return ((xi * std::acos(-xi * c) / k - std::sqrt((1 - xi * xi) * (k * k - 1))) / (k * k) + std::acos(c)) /
         std::numbers::pi;
}

}  // namespace

TEST_CASE("coverage: a sphere above the horizon has its closed form") {
  for (const float distance : {0.3f, 1.0f, 4.0f, 30.0f})
    for (const float radius : {0.02f, 0.1f, 0.25f})
      for (const float elevation : {1.5f, 1.2f, 0.9f}) {
        const Vec3 centre = distance * Vec3{std::cos(elevation), 0, std::sin(elevation)};
        if (centre.z < radius) continue;
        const double sine = double(radius) / double(distance);
        CHECK(std::abs(double(coverage_of(sphere(centre, radius))) -
                       sine * sine * std::sin(double(elevation))) < rounding);
      }
}

TEST_CASE("coverage: a sphere that the horizon clips is within the error of the fit") {
  double largest = 0, sum = 0;
  int count = 0;
  for (float sine = 0.05f; sine < 0.99f; sine += 0.05f)
    for (float height = -0.95f; height < 1; height += 0.1f) {
      const float z = height * sine;
      const Vec3 centre{std::sqrt(1 - z * z), 0, z};
      const double error =
          double(coverage_of(sphere(centre, sine))) - clipped_sphere(double(z), 1, double(sine));
      largest = std::max(largest, std::abs(error));
      sum += error * error;
      ++count;
    }
  // The error that coverage.h states.
  CHECK(largest < 0.0052 + rounding);
  CHECK(std::sqrt(sum / count) < 0.002);
}

TEST_CASE("coverage: an endless cylinder across the normal has its closed form") {
  // A lune with the sine r / h, whose vector points at the axis. 20 m leave out less than (h / 20)^3 of it at
  // each tip, and between ends that are nearly opposite floats have four digits.
  for (const float height : {0.3f, 0.6f, 2.0f})
    for (const float radius : {0.05f, 0.2f}) {
      const Capsule cylinder{{-20, 0, height}, {20, 0, height}, radius, radius};
      const double lune = double(radius) / double(height);
      CHECK(std::abs(double(coverage_of(cylinder)) - lune) < 3e-3 * lune);
    }
}

TEST_CASE("coverage: capsules above the horizon agree with rays") {
  Numbers numbers(5);
  double sum = 0;
  int count = 0;
  while (count < 120) {
    Capsule c{numbers.place(1), numbers.place(1), numbers.between(0.02f, 0.4f), 0};
    c.radius_b = c.radius_a * numbers.between(0.5f, 1.5f);
    if (c.a.z < c.radius_a || c.b.z < c.radius_b || length(c.a) < 1.05f * c.radius_a ||
        length(c.b) < 1.05f * c.radius_b)
      continue;
    const double error = double(coverage_of(c)) - traced_coverage(c);
    // The noise of the rays.
    CHECK(std::abs(error) < 3e-3);
    sum += error * error;
    ++count;
  }
  CHECK(std::sqrt(sum / count) < 1e-3);
}

TEST_CASE("coverage: a capsule through the horizon is close to rays") {
  Numbers numbers(9);
  double sum = 0;
  int count = 0;
  while (count < 120) {
    Capsule c{numbers.place(1), numbers.place(1), numbers.between(0.02f, 0.3f), 0};
    c.radius_b = c.radius_a * numbers.between(0.5f, 1.5f);
    const bool above = c.a.z >= c.radius_a && c.b.z >= c.radius_b;
    const double traced = traced_coverage(c, 2000);
    if (above || traced > 0.999 || meets({0, 0, -1}, {c.a, c.b, c.radius_a * 1.05f, c.radius_b * 1.05f}))
      continue;
    const double error = double(coverage_of(c)) - traced;
    // The region counts as a disc of the same vector at the horizon; a long capsule across it is the worst.
    CHECK(std::abs(error) < 0.12);
    sum += error * error;
    ++count;
  }
  CHECK(std::sqrt(sum / count) < 0.02);
}

TEST_CASE("coverage: where one end hides the other the larger disc counts") {
  const Capsule away{{0, 0, 1}, {0, 0, 3}, 0.2f, 0.2f};
  CHECK(std::abs(double(coverage_of(away)) - 0.04) < rounding);
  const Capsule swapped{away.b, away.a, 0.2f, 0.2f};
  CHECK(std::abs(double(coverage_of(swapped)) - 0.04) < rounding);
}

TEST_CASE("coverage: it does not depend on the order of the ends") {
  Numbers numbers(3);
  for (int i = 0; i < 200; ++i) {
    const Capsule c{numbers.place(1), numbers.place(1), numbers.between(0.02f, 0.3f),
                    numbers.between(0.02f, 0.3f)};
    CHECK(std::abs(coverage_of(c) - coverage_of({c.b, c.a, c.radius_b, c.radius_a})) < 2e-5f);
  }
}

TEST_CASE("coverage: the share is in [0, 1], and continuous through the surface") {
  Numbers numbers(11);
  for (int i = 0; i < 3000; ++i) {
    const Capsule c{numbers.place(0.5f), numbers.place(0.5f), numbers.between(0.02f, 0.5f),
                    numbers.between(0.02f, 0.5f)};
    const float f = coverage_of(c);
    CHECK((f >= 0 && f <= 1));
  }
  // Past the round wall of a capsule, and past its end: steps of 1 mm never jump.
  float before = 0;
  bool first = true;
  for (int i = -500; i < 500; ++i) {
    const float z = 0.001f * float(i);
    const float f = coverage_of({{-0.6f, 0, z}, {0.5f, 0.1f, z}, 0.2f, 0.15f});
    // The steepest place is the surface, where the share rises with the square root of the depth: sqrt(2 *
    // 0.001 / 0.15) is 0.12.
    if (!first) CHECK(std::abs(f - before) < 0.06f);
    before = f;
    first = false;
  }
}

TEST_CASE("coverage: a number that is NaN darkens nothing") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Capsule sound{{0.1f, 0.2f, 0.6f}, {0.3f, 0.1f, 0.9f}, 0.1f, 0.2f};
  for (int i = 0; i < 8; ++i) {
    float numbers[8] = {sound.a.x, sound.a.y, sound.a.z,      sound.b.x,
                        sound.b.y, sound.b.z, sound.radius_a, sound.radius_b};
    numbers[i] = nan;
    const float f = world::coverage<float>(
        {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4], numbers[5], numbers[6], numbers[7]}, 0,
        0, 1);
    CHECK(f == 0);
  }
}
