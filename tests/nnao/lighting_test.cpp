// Lighting with AO and bent normals: limits that hold for any fit.
#include "sdk/src/nnao/lighting.h"

#include <cmath>

#include "tests/catch.h"

using namespace nook;
using namespace nook::nnao;

namespace {

Vec3 direction(float degrees, float turn) {
  const float angle = degrees * 0.017453293f;
  return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
}

}  // namespace

TEST_CASE("an open pixel reflects everything, a closed one nothing that is rough") {
  const SpecularNumbers numbers = specular_numbers();
  for (float view = 0; view < 89; view += 11)
    for (float roughness = 0; roughness <= 1; roughness += 0.25f) {
      const LitPixel open{{0, 0, 1}, {0, 0, 1}, direction(view, 1), 1};
      CHECK(specular_occlusion(numbers, open, roughness) == 1);
      for (float ao = 0; ao <= 1; ao += 0.2f) {
        const LitPixel pixel{direction(20, 2), {0, 0, 1}, direction(view, 1), ao};
        const float occlusion = specular_occlusion(numbers, pixel, roughness);
        CHECK((occlusion >= 0 && occlusion <= 1));
        // Roughness 1 gives AO.
        CHECK(std::abs(specular_occlusion(numbers, pixel, 1) - ao) < 1e-6f);
      }
    }
}

TEST_CASE("a mirror sees what lies along the bent normal, and not what lies against it") {
  const SpecularNumbers numbers = specular_numbers();
  // Half of the hemisphere is open, towards +x: the bent normal leans by atan(2 / pi) from the normal.
  const Vec3 bent = direction(32.48f, 0);
  for (const float view : {30.0f, 45.0f, 60.0f}) {
    const LitPixel towards{bent, {0, 0, 1}, direction(view, 3.1415927f), 0.5f};
    const LitPixel against{bent, {0, 0, 1}, direction(view, 0), 0.5f};
    const float open = specular_occlusion(numbers, towards, 0.15f),
                closed = specular_occlusion(numbers, against, 0.15f);
    INFO(view << " degrees: " << open << " towards the opening, " << closed << " against it");
    // A wall answers 1 and 0; the numbers are a mean over many shapes.
    CHECK(open > 0.65f);
    CHECK(closed < 0.35f);
    CHECK(open - closed > 0.5f);
  }
}

TEST_CASE("light that the surroundings reflect brightens, and more so with a brighter albedo") {
  for (float ao = 0.05f; ao <= 1; ao += 0.05f) {
    float before = ao;
    for (float albedo = 0; albedo <= 0.9f; albedo += 0.1f) {
      const float light = multi_bounce(ao, albedo);
      CHECK(light >= before - 1e-6f);
      CHECK(light <= 1.01f);
      before = light;
    }
  }
  CHECK(std::abs(multi_bounce(1, 0.8f) - 1) < 0.02f);
  CHECK(cone_cosine(1) == 0);
  CHECK(cone_cosine(0) == 1);
  // A cone of 60 degrees has 3/4 of the cosine-weighted hemisphere.
  CHECK(std::abs(cone_cosine(0.75f) - 0.5f) < 1e-6f);
}
