#include "sdk/src/material/direction_mesh.h"

#include <cmath>

#include "tests/catch.h"
#include "tests/material/material_sample.h"

using namespace nook;
using namespace nook::material;

namespace {

// The 81 directions of the Bonn database: rings that lie on common circles and lines.
nook::Vector<Vec3> rings() {
  nook::Vector<Vec3> directions{{0, 0, 1}};
  const int counts[] = {6, 12, 18, 20, 24};
  for (int ring = 0; ring < 5; ++ring)
    for (int i = 0; i < counts[ring]; ++i) {
      const float theta = 0.2617994f * float(ring + 1), phi = 6.2831853f * float(i) / float(counts[ring]);
      directions.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  return directions;
}

ParabolicPoint mixed(const nook::Vector<Vec3>& directions, const DirectionMix& mix) {
  ParabolicPoint p;
  for (int i = 0; i < 3; ++i) {
    const ParabolicPoint corner = to_parabolic(directions[mix.index[i]]);
    p.x += mix.weight[i] * corner.x;
    p.y += mix.weight[i] * corner.y;
  }
  return p;
}
float distance(ParabolicPoint a, ParabolicPoint b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// The plane through three directions cuts the sphere in their circle; others within lie beyond it.
bool circle_is_empty(const nook::Vector<Vec3>& directions, const DirectionMix& mix) {
  const Vec3 a = directions[mix.index[0]], b = directions[mix.index[1]], c = directions[mix.index[2]];
  Vec3 axis = normalised(cross(b - a, c - a));
  if (dot(axis, a + b + c) < 0) axis = -axis;
  for (const Vec3 d : directions)
    // Of directions on the circle itself any three will do: rounding, and the mesh's own jitter of 1e-7.
    if (dot(axis, d) > dot(axis, a) + 1e-5f) return false;
  return true;
}

}  // namespace

TEST_CASE("the parabolic map goes there and back, and the horizon ends it") {
  for (const Vec3 d : test::hemisphere(200)) CHECK(length(from_parabolic(to_parabolic(d)) - d) < 1e-6f);
  const ParabolicPoint below = to_parabolic(normalised({3, 4, -2}));
  CHECK(std::hypot(below.x - 0.6f, below.y - 0.8f) < 1e-6f);
  CHECK(to_parabolic({0, 0, -1}).x == 0);
  CHECK(length(from_parabolic({3, 4}) - Vec3{0.6f, 0.8f, 0}) < 1e-6f);
  for (std::uint32_t row = 0; row < 8; ++row)
    for (std::uint32_t column = 2; column < 6; ++column) {
      const ParabolicPoint p = cell_centre(column, row, 8);
      if (std::hypot(p.x, p.y) < 1) CHECK(cell_of(from_parabolic(p), 8) == row * 8 + column);
    }
}

TEST_CASE("three directions round a point interpolate linearly, and no fourth is nearer") {
  for (const auto& directions : {test::hemisphere(100), test::hemisphere(7), rings()}) {
    const DirectionMesh mesh(directions);
    std::size_t hint = 0, inside = 0;
    for (std::uint32_t row = 0; row < 40; ++row)
      for (std::uint32_t column = 0; column < 40; ++column) {
        const ParabolicPoint p = to_parabolic(from_parabolic(cell_centre(column, row, 40)));
        const DirectionMix mix = mesh.locate(p, hint);
        float sum = 0;
        for (const float weight : mix.weight) {
          CHECK(weight >= 0);
          sum += weight;
        }
        CHECK(std::abs(sum - 1) < 1e-5f);
        if (mix.weight[2] == 0) continue;
        ++inside;
        // The weights belong to points moved by up to 1e-7.
        CHECK(distance(mixed(directions, mix), p) < 1e-5f);
        CHECK(circle_is_empty(directions, mix));
      }
    if (directions.size() > 50) CHECK(inside > 700);
  }
}

TEST_CASE("interpolation at a sampled direction returns the sampled value") {
  const auto directions = rings();
  const DirectionMesh mesh(directions);
  std::size_t hint = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const DirectionMix mix = mesh.locate(to_parabolic(directions[i]), hint);
    float own = 0;
    for (int k = 0; k < 3; ++k)
      if (mix.index[k] == i) own = std::max(own, mix.weight[k]);
    CHECK(own > 1 - 1e-4f);
  }
}

TEST_CASE("interpolation is continuous across triangles and beyond the border") {
  for (const auto& directions : {test::hemisphere(30), rings()}) {
    const DirectionMesh mesh(directions);
    std::size_t hint = 0;
    const auto value = [&](float x, float y) {
      const DirectionMix mix = mesh.locate({x, y}, hint);
      float sum = 0;
      for (int i = 0; i < 3; ++i) sum += mix.weight[i] * std::sin(17.0f * mix.index[i]);
      return sum;
    };
    constexpr int steps = 4000;
    float last = value(-1, 0.13f);
    for (int i = 1; i <= steps; ++i) {
      const float now = value(2 * float(i) / steps - 1, 0.13f + 0.1f * float(i) / steps);
      // Corners differ by at most 2 and lie at least 0.05 apart, so a step of 5e-4 changes at most 0.02, and
      // thin triangles at the border some times that.
      CHECK(std::abs(now - last) < 0.1f);
      last = now;
    }
  }
}

TEST_CASE("one, two and three directions in a line are enough") {
  std::size_t hint = 0;
  const nook::Vector<Vec3> one{{0, 0, 1}};
  const DirectionMix alone = DirectionMesh(one).locate({0.5f, 0.5f}, hint);
  CHECK(alone.index[0] == 0);
  CHECK(alone.weight[0] + alone.weight[1] == 1);
  const nook::Vector<Vec3> line{{0, 0, 1}, {0.6f, 0, 0.8f}, {1, 0, 0}};
  for (std::size_t count : {2u, 3u}) {
    const nook::Vector<Vec3> some(line.begin(), line.begin() + std::ptrdiff_t(count));
    const DirectionMesh mesh(some);
    for (const float x : {-0.5f, 0.0f, 0.1f, 0.2f, 1.0f / 3}) {
      const DirectionMix mix = mesh.locate({x, 0.3f}, hint);
      CHECK(std::abs(mixed(some, mix).x - std::max(x, 0.0f)) < 1e-3f);
    }
  }
}
