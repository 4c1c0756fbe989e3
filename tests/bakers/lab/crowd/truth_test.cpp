#include "bakers/lab/crowd/truth.h"

#include <cmath>
#include <numbers>

#include "tests/bakers/lab/crowd/plates.h"
#include "tests/catch.h"

using namespace nook::lab::crowd;

namespace {

constexpr std::uint32_t kRays = 4096;
// Four standard deviations of a share of 0.5 that is estimated with kRays rays.
const float kNoise = 4 * 0.5f / std::sqrt(float(kRays));

}  // namespace

TEST_CASE("the ground darkens a plate by the share of the hemisphere that it covers") {
  const plates::Character character = plates::make_character();
  const std::vector<Bones> poses{plates::pose(0, 1, 0, 0.25f), plates::pose(50, 1, 0, 0.5f)};
  const PosedCrowd crowd(character.get(), poses);
  const std::uint32_t receivers[] = {0, 1};
  const VertexValues on_ground = traced_ao(crowd, receivers, {kRays, 1, true});
  const VertexValues alone = traced_ao(crowd, receivers, {kRays, 1, false});
  // The upright plate looks at ground with half of its hemisphere, the one that lies upside down with all of
  // it.
  CHECK(std::abs(on_ground[0][plates::kCentre] - 0.5) < kNoise);
  CHECK(std::abs(on_ground[1][plates::kCentre]) < 1e-3);
  CHECK(alone[0][plates::kCentre] == 1);
  CHECK(alone[1][plates::kCentre] == 1);
}

TEST_CASE("a plate above darkens a body and the floor by its form factor") {
  const plates::Character character = plates::make_character();
  const std::vector<Bones> poses{plates::pose(0, 0.1f, 0), plates::pose(0, 0.8f, 0)};
  const PosedCrowd crowd(character.get(), poses);
  const std::uint32_t lower[] = {0}, upper[] = {1};
  const VertexValues ao = traced_ao(crowd, lower, {kRays, 1, true});
  CHECK(std::abs(ao[0][plates::kCentre] - (1 - plates::covered_share(0.7f))) < kNoise);
  // The patch's point 4 of 3 x 3 lies at the origin.
  const FloorPatch patch{-1, -1, 2, 3};
  const auto floor = [&](float radius_m) {
    return traced_floor_ao(crowd, upper, patch, radius_m, {kRays, 1, true})[4];
  };
  CHECK(std::abs(floor(INFINITY) - (1 - plates::covered_share(0.8f))) < kNoise);
  CHECK(floor(0.7f) == 1);
}

TEST_CASE("under constant light irradiance is pi times the radiance times AO") {
  const plates::Character character = plates::make_character();
  const std::vector<Bones> poses{plates::pose(0, 0.8f, 0, 0.25f)};
  const PosedCrowd crowd(character.get(), poses);
  std::vector<float> rgb;
  for (int texel = 0; texel < 4 * 2; ++texel) rgb.insert(rgb.end(), {1, 2, 3});
  const std::uint32_t receivers[] = {0};
  const FloorPatch patch{-1, 3, 2, 2};
  const TracedIrradiance traced = traced_irradiance(crowd, receivers, &patch, {rgb.data(), 4, 2}, {kRays, 1});
  REQUIRE(traced.bodies.at(0).size() == 3 * plates::kVertices);
  REQUIRE(traced.floor.size() == 3 * 4);
  for (int c = 0; c < 3; ++c) {
    const float unit = std::numbers::pi_v<float> * float(c + 1);
    CHECK(std::abs(traced.bodies[0][3 * plates::kCentre + std::size_t(c)] / unit - 0.5) < kNoise);
    // Three metres away the plate covers less than a tenth of the sky.
    CHECK(traced.floor[std::size_t(c)] / unit > 0.9f);
    CHECK(traced.floor[std::size_t(c)] / unit <= 1.0001f);
  }
}

TEST_CASE("errors are means over used vertices, and over the area that each stands for") {
  const plates::Character character = plates::make_character();
  const std::vector<Bones> poses{plates::pose(0, 1, 0)};
  const PosedCrowd crowd(character.get(), poses);
  const std::uint32_t receivers[] = {0};
  const VertexValues reference(1, std::vector<float>(plates::kVertices, 0.5f));
  VertexValues values = reference;
  values[0][plates::kCentre] += 0.25f;
  values[0].back() = 100;  // of the vertex that no triangle uses
  const Errors errors = compare(crowd, receivers, values, reference);
  CHECK(std::abs(errors.mse - 0.0625 / plates::kUsed) < 1e-9);
  // Six triangles of half a cell give a vertex inside the plate a third of their area each: one cell.
  CHECK(std::abs(errors.mse_area - 0.0625 / plates::kCells) < 1e-9);

  VertexValues rgb(1, std::vector<float>(3 * plates::kVertices, 0.0f)), dark = rgb;
  for (std::size_t i = 0; i < rgb[0].size(); i += 3) rgb[0][i] = 1;
  CHECK(std::abs(compare(crowd, receivers, rgb, dark, 3, 2.0f).mse - 0.25 / 3) < 1e-9);
}
