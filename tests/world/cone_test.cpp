#include "sdk/src/world/cone.h"

#include <cmath>
#include <numbers>

#include "tests/catch.h"
#include "tests/character/model_sample.h"
#include "tests/world/directions.h"

using namespace nook;
using namespace nook::test;

namespace {

float hidden_share(const Capsule& c, const world::ConeParts& parts) {
  float hidden = 0;
  for (const Vec3 axis : parts.axis)
    hidden += world::part_coverage<float>(lanes_of(c), axis.x, axis.y, axis.z, parts.slope);
  return hidden / float(world::cone_parts);
}

double traced_share(const Capsule& c, Vec3 axis, double half_angle, int directions = 3000) {
  const Vec3 x = normalised(cross(axis, std::abs(axis.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  const Vec3 y = cross(axis, x);
  const double versine = 1 - std::cos(half_angle);
  int hits = 0;
  for (int i = 0; i < directions; ++i) {
    const double w = versine * (i + 0.5) / directions, sine = std::sqrt(w * (2 - w)),
                 angle = 2.399963229728653 * i;
    hits +=
        meets(float(sine * std::cos(angle)) * x + float(sine * std::sin(angle)) * y + float(1 - w) * axis, c);
  }
  return double(hits) / directions;
}

}  // namespace

TEST_CASE("cone: the parts share the solid angle, and stay inside the cone") {
  for (const float half : {0.04f, 0.17f, 0.52f, 1.2f}) {
    const Vec3 axis = normalised({0.3f, 0.8f, -0.5f});
    const world::ConeParts parts = world::cone_parts_of(axis, half);
    for (const Vec3 part : parts.axis) {
      CHECK(std::abs(length(part) - 1) < 1e-5f);
      CHECK(std::acos(std::min(dot(part, axis), 1.0f)) < half);
    }
    // A part's solid angle, 2 pi (1 - cos), is a sixteenth of the cone's.
    const double part = 1 - std::cos(std::atan(double(parts.slope)));
    const double whole = 1 - std::cos(double(half));
    CHECK(std::abs(part * world::cone_parts - whole) < 1e-4 * whole);
  }
}

TEST_CASE("cone: a capsule that fills it hides all, one aside or behind nothing") {
  const world::ConeParts parts = world::cone_parts_of({0, 0, 1}, 0.2f);
  CHECK(hidden_share({{-3, 0, 2}, {3, 0, 2}, 1.5f, 1.5f}, parts) == 1);
  CHECK(hidden_share({{2, 0, 2}, {2, 1, 2}, 0.3f, 0.3f}, parts) == 0);
  CHECK(hidden_share({{0, 0, -2}, {0, 1, -2}, 0.5f, 0.5f}, parts) == 0);
  CHECK(hidden_share({{0, 0, -2}, {NAN, 1, -2}, 0.5f, 0.5f}, parts) == 0);
}

TEST_CASE("cone: shares agree with rays") {
  Numbers numbers(21);
  double sum = 0;
  int count = 0;
  const Vec3 axis = normalised({0.2f, 0.3f, 1});
  for (const float half : {0.0436f, 0.1745f, 0.5236f}) {
    const world::ConeParts parts = world::cone_parts_of(axis, half);
    for (int i = 0; i < 60; ++i) {
      const Vec3 middle = numbers.between(0.6f, 2.5f) * axis + numbers.place(0.3f),
                 along = numbers.place(0.3f);
      Capsule c{middle - along, middle + along, numbers.between(0.05f, 0.15f), 0};
      c.radius_b = c.radius_a * numbers.between(0.7f, 1.4f);
      if (length(c.a) < 1.5f * c.radius_a || length(c.b) < 1.5f * c.radius_b) continue;
      const double error = double(hidden_share(c, parts)) - traced_share(c, axis, double(half));
      // A capsule counts as a rectangle in each part: at a corner, and where it is cut aslant, a share of a
      // part is wrong. The cone's share is a mean of sixteen.
      CHECK(std::abs(error) < 0.25);
      sum += error * error;
      ++count;
    }
  }
  CHECK(count > 100);
  CHECK(std::sqrt(sum / count) < 0.05);
}
