// A mesh of one's own as a meso-structure.
#include "bakers/material/meso_surface.h"

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "bakers/material/shading.h"
#include "bakers/raytrace/ray_scene.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::bake::material;

namespace {

// A closed box, y up, in metres.
StaticScene box(Vec3 low, Vec3 high) {
  StaticScene scene;
  for (int i = 0; i < 8; ++i)
    scene.position.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  const std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{2, 6, 7, 3}, {0, 1, 5, 4}, {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    scene.triangle.push_back({f[0], f[1], f[2]});
    scene.triangle.push_back({f[0], f[2], f[3]});
  }
  scene.triangle_surface.assign(12, 0);
  scene.surface.resize(1);
  scene.surface[0].base_colour = {0.25f, 0.5f, 0.75f};
  return scene;
}

std::string refusal(const StaticScene& scene, float side_m) {
  try {
    tile_of_scene(scene, side_m);
    return {};
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
    return failure.what();
  }
}

}  // namespace

TEST_CASE("a mesh becomes a tile: scaled, z up, around the middle height, its front outside") {
  // 2 x 1 x 1 metres in tiles of 4 metres, 8 metres away along x.
  const MesoSurface surface = tile_of_scene(box({8.5f, 2, -3}, {10.5f, 3, -2}), 4);
  const FlushDenormals flush;
  const TiledScene scene(surface);
  CHECK(scene.top() == Approx(0.125f));
  CHECK(scene.bottom() == Approx(-0.125f));
  // x is 8.5 to 10.5 metres, 0.125 to 0.625 tiles; y is 2 to 3 metres of -z, 0.5 to 0.75 tiles.
  const auto hit = [&](float x, float y) { return scene.nearest({x, y, 1}, {0, 0, -1}); };
  for (const auto& [x, y] : {std::pair{0.13f, 0.51f}, std::pair{0.62f, 0.74f}, std::pair{1.3f, -0.4f}}) {
    const SurfaceHit h = hit(x, y);
    REQUIRE(h.triangle != SurfaceHit::nothing);
    CHECK(h.position.z == Approx(0.125f));
    CHECK(h.normal.z == Approx(1));
  }
  CHECK(hit(0.1f, 0.6f).triangle == SurfaceHit::nothing);
  CHECK(hit(0.4f, 0.8f).triangle == SurfaceHit::nothing);
  CHECK(surface.albedo[0] == Vec3{0.25f, 0.5f, 0.75f});
}

TEST_CASE("normals of a surface that goes on across the border of the tile agree on both sides") {
  // A strip along x, bent at its ends: its slope is 0.2 at x = 0 and -0.2 at x = 1, so that they meet in a
  // ridge whose normal is upright.
  StaticScene strip;
  strip.surface.push_back({});
  for (const auto& [x, y] : {std::pair{0.0f, 0.1f}, std::pair{0.5f, 0.0f}, std::pair{1.0f, 0.1f}})
    for (const float z : {0.25f, 0.75f}) strip.position.push_back({x, y, z});
  strip.triangle = {{0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}};
  strip.triangle_surface.assign(4, 0);
  const MesoSurface surface = tile_of_scene(strip, 1);
  for (const std::size_t v : {0u, 1u, 4u, 5u}) {
    CHECK(surface.normal[v].x == Approx(0).margin(1e-5));
    CHECK(std::abs(surface.normal[v].z) == Approx(1).margin(1e-5));
  }
}

TEST_CASE("a mesh that is not a tile is refused") {
  const StaticScene good = box({0, 0, 0}, {1, 0.25f, 1});
  CHECK(refusal(good, 1).empty());
  CHECK(refusal(good, 0).find("the side of the tile") != std::string::npos);
  CHECK(refusal(good, std::numeric_limits<float>::quiet_NaN()).find("the side of the tile") !=
        std::string::npos);
  CHECK(refusal(good, 0.4f).find("tiles high") != std::string::npos);
  CHECK(refusal(box({0, 0, 0}, {3, 0.25f, 1}), 1).find("tiles wide") != std::string::npos);
  CHECK(refusal(box({0, 0, 0}, {1, 0, 1}), 1).find("tiles high") != std::string::npos);
  StaticScene bad = good;
  bad.position[3].y = std::numeric_limits<float>::infinity();
  CHECK_FALSE(refusal(bad, 1).empty());
}
