// The reference of specular occlusion against shapes whose answer is known.
#include "bakers/raytrace/specular_visibility.h"

#include <cmath>
#include <limits>

#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

// A wall through the origin: the half-plane x = 0, z >= 0 side facing +x, very large.
TriangleSoup wall() {
  constexpr float far = 1000;
  TriangleSoup soup;
  soup.position = {{0, -far, -far}, {0, far, -far}, {0, far, far}, {0, -far, far}};
  soup.triangle = {{0, 1, 2}, {0, 2, 3}};
  return soup;
}

GlossyPoint beside_wall(Vec3 to_viewer) {
  return {{1e-3f, 0, 0}, {0, 0, 1}, normalised(to_viewer), std::numeric_limits<float>::infinity(), 1e-5f};
}

}  // namespace

TEST_CASE("a reflection without occluders is open at every roughness") {
  const FlushDenormals flush;
  const RayScene scene(TriangleSoup{});
  for (const float roughness : {0.05f, 0.5f, 1.0f})
    CHECK(trace_specular_visibility(scene, beside_wall({-1, 0, 1}), roughness, 64, 1) == 1);
}

TEST_CASE("a mirror beside a wall sees the wall or the open side") {
  const FlushDenormals flush;
  const RayScene scene(wall());
  CHECK(trace_specular_visibility(scene, beside_wall({-1, 0, 1}), 0.05f, 256, 1) > 0.999f);
  CHECK(trace_specular_visibility(scene, beside_wall({1, 0, 1}), 0.05f, 256, 1) < 0.001f);
}

TEST_CASE("seen along the normal a half of every reflection meets the wall") {
  const FlushDenormals flush;
  const RayScene scene(wall());
  for (const float roughness : {0.3f, 0.7f, 1.0f})
    // 16,384 rays: a deviation of 0.004.
    CHECK(std::abs(trace_specular_visibility(scene, beside_wall({0, 0, 1}), roughness, 16384, 3) - 0.5f) <
          0.016f);
}

TEST_CASE("hits beyond the radius are open") {
  const FlushDenormals flush;
  const RayScene scene(wall());
  GlossyPoint point = beside_wall({1, 0, 1});
  point.position.x = 0.5f;
  point.radius = 0.4f;
  CHECK(trace_specular_visibility(scene, point, 0.2f, 64, 1) == 1);
}
