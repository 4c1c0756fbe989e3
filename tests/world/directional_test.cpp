#include "sdk/src/world/light_terms.h"

#include <cmath>
#include <vector>

#include "tests/catch.h"
#include "tests/character/model_sample.h"
#include "tests/world/directions.h"

using namespace nook;
using namespace nook::test;

namespace {

struct Shares {
  double hemisphere = 0;  // that the capsule covers
  double open = 0;        // of the green light, the part that it leaves
};

// By a spiral of directions round +z, weighted by the cosine.
Shares traced(const Capsule& c, const std::vector<SphericalGaussian>& lobes, int directions = 2000) {
  Shares shares;
  double all = 0;
  for (int i = 0; i < directions; ++i) {
    const double square = (i + 0.5) / directions, angle = 2.399963229728653 * i, radius = std::sqrt(square);
    const Vec3 d{float(radius * std::cos(angle)), float(radius * std::sin(angle)),
                 float(std::sqrt(1 - square))};
    double light = 0;
    for (const SphericalGaussian& lobe : lobes) light += double(value(lobe, d).y);
    all += light;
    if (meets(d, c))
      shares.hemisphere += 1.0 / directions;
    else
      shares.open += light;
  }
  shares.open /= all;
  return shares;
}

struct Result {
  float ao;
  Colour<float> open;
};

Result evaluated(const std::vector<Capsule>& casters, const world::LightTerms& light) {
  const Direction<float> n{0, 0, 1};
  world::GatheredTerms<float> gathered = world::GatheredTerms<float>::none();
  float ao = 1;
  for (const Capsule& c : casters) {
    Direction<float> phi{};
    const float share = world::coverage<float>(lanes_of(c), n.x, n.y, n.z, phi);
    world::gather(gathered, n, phi, share);
    ao *= 1 - share;
  }
  return {ao, world::open_light(gathered, light, n, ao)};
}

std::vector<SphericalGaussian> random_lobes(Numbers& numbers, float sharpest) {
  std::vector<SphericalGaussian> lobes{{{0, 0, 1}, 0, {0.3f, 0.3f, 0.3f}}};
  for (int i = 0; i < 3; ++i)
    lobes.push_back({numbers.direction(),
                     numbers.between(0.2f, sharpest),
                     {numbers.between(0, 2), numbers.between(0, 2), numbers.between(0, 2)}});
  return lobes;
}

}  // namespace

TEST_CASE("directional: under constant light every channel is AO") {
  Numbers numbers(5);
  world::LightTerms light;
  light.term[0] = light.darkest = {0.2f, 1, 3};
  for (int i = 0; i < 100; ++i) {
    const std::vector<Capsule> casters{{numbers.place(1), numbers.place(1), 0.1f, 0.2f},
                                       {numbers.place(1), numbers.place(1), 0.2f, 0.1f}};
    const Result r = evaluated(casters, light);
    for (const float channel : {r.open.r, r.open.g, r.open.b}) CHECK(std::abs(channel - r.ao) < 1e-5f);
  }
}

TEST_CASE("directional: a caster that fills the hemisphere takes all light, and none takes nothing") {
  Numbers numbers(6);
  for (int i = 0; i < 20; ++i) {
    const world::LightTerms light = world::terms_of(random_lobes(numbers, 2));
    // Round the point, and much larger.
    CHECK(evaluated({{{-5, 0, 5}, {5, 0, 5}, 5.0f, 5.0f}}, light).open.g < 0.01f);
    CHECK(evaluated({}, light).open.g == 1);
  }
}

TEST_CASE("directional: the open share of soft light comes near the rays', much nearer than AO") {
  Numbers numbers(8);
  double error = 0, plain = 0, bias = 0;
  int count = 0;
  for (int i = 0; i < 120; ++i) {
    const std::vector<SphericalGaussian> lobes = random_lobes(numbers, 3);
    const world::LightTerms light = world::terms_of(lobes);
    // Each in a statement of its own, since compilers differ in the order of operands.
    const float distance = numbers.between(0.6f, 2.0f);
    const Vec3 a = distance * numbers.direction();
    const Capsule caster{a, a + numbers.place(0.5f), 0.15f, 0.25f};
    const Shares truth = traced(caster, lobes);
    // Neither casters that hardly count, nor one that holds the point: it keeps the half-space of its
    // surface.
    if (truth.hemisphere < 0.01 || truth.hemisphere > 0.999) continue;
    const double off = double(evaluated({caster}, light).open.g) - truth.open,
                 ao = 1 - truth.hemisphere - truth.open;
    error += off * off;
    plain += ao * ao;
    bias += off;
    ++count;
  }
  INFO("rms " << std::sqrt(error / count) << ", of AO " << std::sqrt(plain / count));
  REQUIRE(count > 20);
  // Lobes of a sharpness up to 3 have some of their power above band 2, and near casters are not discs.
  CHECK(error < 0.2 * plain);
  CHECK(std::abs(bias / count) < 0.01);
}

TEST_CASE("directional: the terms of many broad lobes are their radiance") {
  Numbers numbers(11);
  std::vector<SphericalGaussian> lobes;
  for (std::size_t i = 0; i < world::lobes_for_all_bands; ++i)
    lobes.push_back({numbers.direction(), numbers.between(0.1f, 1), {numbers.between(0, 1), 1, 1}});
  const world::LightTerms light = world::terms_of(lobes);
  for (int i = 0; i < 50; ++i) {
    const Vec3 d = numbers.direction();
    double radiance = 0;
    for (const SphericalGaussian& lobe : lobes) radiance += double(value(lobe, d).x);
    // A density of one direction alone, whose bands undo the taper.
    world::GatheredTerms<float> gathered = world::GatheredTerms<float>::none();
    gathered.add({d.x, d.y, d.z}, 1, {1, 1, 1, 1 / 0.8f, 1 / 0.6f});
    // Band 5 of a lobe of sharpness 1 is 3e-4 of its mean, and at most 11 times as much in one direction.
    CHECK(std::abs(double(gathered.light(light, &Vec3::x)) / radiance - 1) < 2e-3);
  }
}

TEST_CASE("directional: bands 3 and 4 of many lobes bring the open share nearer to the rays'") {
  Numbers numbers(12);
  double error = 0, to_band_2 = 0;
  for (int i = 0; i < 60; ++i) {
    std::vector<SphericalGaussian> lobes;
    for (std::size_t k = 0; k < world::lobes_for_all_bands; ++k) {
      const Vec3 axis = numbers.direction();
      // A few lamps in dim light.
      const float bright = numbers.between(0, 1) < 0.1f ? 2.0f : 0.1f;
      lobes.push_back({axis, 8, {bright, bright, bright}});
    }
    const world::LightTerms light = world::terms_of(lobes);
    world::LightTerms blurred = light;
    for (int k = 9; k < world::light_term_count; ++k) blurred.term[k] = {};
    const float distance = numbers.between(0.8f, 2.0f);
    const Vec3 a = distance * numbers.direction(), b = a + numbers.place(0.3f);
    const Capsule caster{a, b, 0.2f, 0.25f};
    const Shares truth = traced(caster, lobes, 1000);
    if (truth.hemisphere < 0.01 || truth.hemisphere > 0.999) continue;
    const auto square = [&](const world::LightTerms& of) {
      const double off = double(evaluated({caster}, of).open.g) - truth.open;
      return off * off;
    };
    error += square(light);
    to_band_2 += square(blurred);
  }
  INFO("mean squared error over the error of bands 0 to 2: " << error / to_band_2);
  // The rest of the error lies in the bands above and in the taper.
  CHECK(error < 0.6 * to_band_2);
}

TEST_CASE("directional: a shadow falls away from the light") {
  // A window towards +x; the caster stands towards it, or on the other side.
  const std::vector<SphericalGaussian> window{{{1, 0, 0}, 2, {1, 1, 1}}, {{0, 0, 1}, 0, {0.1f, 0.1f, 0.1f}}};
  const world::LightTerms light = world::terms_of(window);
  const Result before = evaluated({{{1, 0, 0}, {1, 0, 1.5f}, 0.2f, 0.2f}}, light),
               behind = evaluated({{{-1, 0, 0}, {-1, 0, 1.5f}, 0.2f, 0.2f}}, light);
  CHECK(before.ao == behind.ao);
  CHECK(1 - before.open.g > 1.3f * (1 - before.ao));
  CHECK(1 - behind.open.g < 0.6f * (1 - behind.ao));
}

TEST_CASE("directional: a caster's shadow in one lobe agrees with ray tracing, from above and aslant") {
  const Capsule sphere{{0, 0, 1}, {0, 0, 1.001f}, 0.3f, 0.3f},
      standing{{0, 0, 0.15f}, {0, 0, 1.5f}, 0.15f, 0.15f};
  // Of the squared error of AO, with a third of margin over what was found; an upright capsule under light
  // from above is not a disc, and left out.
  const struct {
    Capsule caster;
    Vec3 towards;
    double most;
  } cases[] = {{sphere, {0, 0, 1}, 0.073}, {sphere, {1, 0, 1}, 0.033}, {standing, {1, 0, 1}, 0.057}};
  for (const auto& planted : cases) {
    const std::vector<SphericalGaussian> lobes{{normalised(planted.towards), 2, {1, 1, 1}},
                                               {{0, 0, 1}, 0, {0.05f, 0.05f, 0.05f}}};
    const world::LightTerms light = world::terms_of(lobes);
    double error = 0, plain = 0;
    for (int i = 0; i < 60; ++i) {
      const float distance = 2.2f * std::sqrt((float(i) + 0.5f) / 60), angle = 2.399963f * float(i);
      const Vec3 point{distance * std::cos(angle), distance * std::sin(angle), 0};
      const Capsule& c = planted.caster;
      const Capsule seen{c.a - point, c.b - point, c.radius_a, c.radius_b};
      const double truth = traced(seen, lobes, 1500).open;
      const Result found = evaluated({seen}, light);
      error += std::pow(double(found.open.g) - truth, 2);
      plain += std::pow(double(found.ao) - truth, 2);
    }
    INFO("towards " << planted.towards.x << ": " << error / plain << " of AO");
    CHECK(error < planted.most * plain);
  }
}
