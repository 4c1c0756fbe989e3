#include "sdk/src/world/caster_parts.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/character/scene.h"
#include "sdk/src/world/coverage.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

float covered(const Capsule& c, Vec3 point, Vec3 n) {
  const Vec3 a = c.a - point, b = c.b - point;
  return world::coverage<float>({a.x, a.y, a.z, b.x, b.y, b.z, c.radius_a, c.radius_b}, n.x, n.y, n.z);
}

// A limb of four capsules that bends.
std::vector<PosedCaster> limb(Numbers& numbers, Vec3 from, Vec3 along) {
  std::vector<PosedCaster> casters;
  for (int i = 0; i < 4; ++i) {
    const Vec3 to = from + 0.12f * normalised(along + 0.4f * numbers.direction());
    casters.push_back({{from, to, 0.08f - 0.01f * float(i), 0.07f - 0.01f * float(i)}, 0.95f});
    from = to;
  }
  return casters;
}

std::vector<PosedCaster> body(Numbers& numbers) {
  std::vector<PosedCaster> all{{{{0, 0.1f, 0}, {0, 0.5f, 0}, 0.13f, 0.15f}, 0.95f},
                               {{{0, 0.65f, 0}, {0, 0.75f, 0}, 0.08f, 0.1f}, 0.95f}};
  for (const float side : {-1.0f, 1.0f})
    for (const Vec3 from : {Vec3{0.1f * side, 0, 0}, Vec3{0.2f * side, 0.5f, 0}}) {
      const std::vector<PosedCaster> own = limb(numbers, from, {0.2f * side, -1, 0});
      all.insert(all.end(), own.begin(), own.end());
    }
  return all;
}

std::vector<std::uint8_t> all_of(std::size_t count) {
  std::vector<std::uint8_t> order;
  for (std::size_t i = 0; i < count; ++i) order.push_back(std::uint8_t(i));
  return order;
}

}  // namespace

TEST_CASE("caster parts: each caster is in one part, beside its neighbours") {
  Numbers numbers(2);
  for (const std::size_t count :
       {std::size_t(1), std::size_t(5), std::size_t(6), std::size_t(40), std::size_t(64)}) {
    std::vector<Vec3> middle;
    for (std::size_t i = 0; i < count; ++i)
      middle.push_back(
          {numbers.between(0, 0.3f) + float(i % 4), numbers.between(0, 0.3f), numbers.between(0, 0.3f)});
    const world::CasterParts parts = world::parts_of(middle);
    REQUIRE(parts.count == (count + 4) / 5);
    std::vector<int> met(count);
    for (std::uint32_t p = 0; p < parts.count; ++p) {
      CHECK(parts.first[p] < parts.first[p + 1]);
      for (std::uint32_t i = parts.first[p]; i < parts.first[p + 1]; ++i) {
        ++met[parts.order[i]];
        // With four parts or more no part holds two of the four heaps, which are 0.7 apart.
        if (parts.count >= 4) CHECK(parts.order[i] % 4 == parts.order[parts.first[p]] % 4);
      }
    }
    CHECK(std::all_of(met.begin(), met.end(), [](int n) { return n == 1; }));
  }
  CHECK(world::parts_of({}).count == 0);
}

TEST_CASE("caster parts: a single capsule with equal radii is not changed") {
  const std::vector<PosedCaster> one{{{{0.2f, 0, 0}, {0.2f, 0.6f, 0}, 0.1f, 0.1f}, 1}};
  const Capsule c = world::merged(one, all_of(1));
  CHECK(std::abs(c.radius_a - 0.1f) < 1e-5f);
  CHECK(std::abs(c.radius_b - 0.1f) < 1e-5f);
  CHECK(std::abs(std::abs(c.a.y - c.b.y) - 0.6f) < 1e-4f);
  CHECK(std::abs(c.a.x - 0.2f) < 1e-5f);
}

TEST_CASE("caster parts: the capsule of a bent part ends where the part does") {
  // A lower leg over a foot: the variance along the axis fits a longer segment, which would reach through the
  // floor at y = 0.
  const std::vector<PosedCaster> leg{{{{0, 0.45f, 0}, {0, 0.28f, 0}, 0.06f, 0.055f}, 1},
                                     {{{0, 0.28f, 0}, {0, 0.1f, 0}, 0.05f, 0.04f}, 1},
                                     {{{0, 0.04f, -0.04f}, {0, 0.04f, 0.12f}, 0.04f, 0.035f}, 1},
                                     {{{0, 0.02f, 0.14f}, {0, 0.02f, 0.22f}, 0.02f, 0.015f}, 1}};
  const Capsule one = world::merged(leg, all_of(leg.size()));
  const Vec3 axis = normalised(one.b - one.a);
  float low = 1e9f, high = -1e9f;
  for (const PosedCaster& c : leg)
    for (const auto& [end, radius] :
         {std::pair(c.capsule.a, c.capsule.radius_a), std::pair(c.capsule.b, c.capsule.radius_b)}) {
      low = std::min(low, dot(axis, end) - radius);
      high = std::max(high, dot(axis, end) + radius);
    }
  // Three steps towards the radius of the shortened segment leave a millimetre.
  CHECK(dot(axis, one.a) - one.radius_a > low - 1e-3f);
  CHECK(dot(axis, one.b) + one.radius_b < high + 1e-3f);
  // Without that end it would be at -0.05 m; the leg has a larger radius than the toes.
  CHECK(std::min(one.a.y, one.b.y) - one.radius_a > -0.03f);
  // The leg is about as long as it was.
  CHECK(length(one.b - one.a) > 0.3f);
}

TEST_CASE("caster parts: beyond the merging distance the rms of the difference is about the error") {
  Numbers numbers(5);
  for (const float error : {1.0f / 64, 1.0f / 256, 1.0f / 1024})
    for (int i = 0; i < 3; ++i) {
      const std::vector<PosedCaster> casters = i == 0 ? limb(numbers, {}, {0, 1, 0}) : body(numbers);
      const Capsule one = world::merged(casters, all_of(casters.size()));
      const Vec3 centre = 0.5f * (one.a + one.b);
      float strength = 0, radius = 0;
      for (const PosedCaster& c : casters) {
        strength += caster_strength(c);
        radius = std::max({radius, length(c.capsule.a - centre) + c.capsule.radius_a,
                           length(c.capsule.b - centre) + c.capsule.radius_b});
      }
      const float distance = world::merging_distance(strength, radius, error);
      double sum = 0;
      constexpr int points = 2000;
      for (int k = 0; k < points; ++k) {
        const Vec3 point = centre + distance * numbers.direction(), normal = numbers.direction();
        float open = 1;
        for (const PosedCaster& c : casters) {
          Capsule scaled = c.capsule;
          scaled.radius_a *= c.ao_scale;
          scaled.radius_b *= c.ao_scale;
          open *= 1 - covered(scaled, point, normal);
        }
        const double off = double(open) - (1 - double(covered(one, point, normal)));
        sum += off * off;
      }
      INFO("error " << error << ", distance " << distance << ", radius " << radius);
      // "About": bodies differ in how far they are from a capsule.
      CHECK(std::sqrt(sum / points) < 1.6 * double(error));
    }
  CHECK(world::merging_distance(1, 1, 0) > 1e14f);
}
