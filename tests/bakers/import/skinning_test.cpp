// Skinning, normals and areas against closed forms.
#include "bakers/import/skinned_mesh.h"

#include "bakers/import/weld.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

float distance(Vec3 a, Vec3 b) {
  return length(a - b);
}

std::vector<Vec3> normals(const Triangles& triangles, const std::vector<Vec3>& positions) {
  std::vector<Vec3> out;
  vertex_normals(triangles, positions, out);
  return out;
}

std::vector<float> areas(const Triangles& triangles, const std::vector<Vec3>& positions) {
  SkinnedMesh mesh;
  mesh.triangle = triangles;
  return vertex_areas(mesh, positions);
}

}  // namespace

TEST_CASE("skinning blends matrices by weight, up to eight of them") {
  SkinnedMesh mesh;
  mesh.bones.resize(8);
  mesh.position = {{1, 2, 3}, {1, 2, 3}};
  std::vector<std::pair<std::uint16_t, float>> all;
  for (std::uint16_t b = 0; b < 8; ++b) all.push_back({b, 1.0f});
  const std::pair<std::uint16_t, float> one{3, 1.0f};
  mesh.weights = {make_weights(all), make_weights({&one, 1})};
  Pose pose(8);
  for (int b = 0; b < 8; ++b) pose[b].m[3] = static_cast<float>(b);  // shifts along x by 0 to 7
  std::vector<Vec3> posed;
  skin_positions(mesh, pose, posed);
  CHECK(distance(posed[0], {4.5f, 2, 3}) < 1e-6f);
  CHECK(distance(posed[1], {4, 2, 3}) < 1e-6f);
  pose.pop_back();
  CHECK_THROWS_AS(skin_positions(mesh, pose, posed), Failure);
}

TEST_CASE("normals weigh faces by area") {
  // A face of area 1/2 towards +z and one of area 3/2 towards +x that share a vertex: the normal leans three
  // to one.
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 3, 0}, {0, 0, 1}};
  const std::vector<Vec3> n = normals({{0, 1, 2}, {0, 3, 4}}, p);
  CHECK(distance(n[0], normalised({3, 0, 1})) < 1e-6f);
  CHECK(distance(n[1], {0, 0, 1}) < 1e-6f);
  CHECK(distance(n[3], {1, 0, 0}) < 1e-6f);
}

TEST_CASE("if the normals of two faces cancel out, the vertex gets the normal of one face") {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Vec3 n : normals({{0, 1, 2}, {0, 2, 1}}, p)) CHECK(distance(n, {0, 0, 1}) < 1e-6f);
}

TEST_CASE("without a face of any area the normal is up") {
  const std::vector<Vec3> p = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 5, 5}};
  for (const Vec3 n : normals({{0, 1, 2}}, p)) CHECK(n == Vec3{0, 1, 0});
}

TEST_CASE("tiny faces have normals too") {
  const float s = 1e-4f;  // a tenth of a millimetre
  for (const Vec3 n : normals({{0, 1, 2}}, {{0, 0, 0}, {0, 0, s}, {s, 0, 0}}))
    CHECK(distance(n, {0, 1, 0}) < 1e-6f);
}

TEST_CASE("mixed Voronoi areas") {
  SECTION("equilateral: thirds") {
    const float h = std::sqrt(3.0f) / 2;
    for (const float a : areas({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0.5f, h, 0}}))
      CHECK(std::abs(a - h / 6) < 1e-6f);
  }
  SECTION("right angle: half at the corner") {
    const std::vector<float> a = areas({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    CHECK(std::abs(a[0] - 0.25f) < 1e-6f);
    CHECK(std::abs(a[1] - 0.125f) < 1e-6f);
  }
  SECTION("obtuse: half at the obtuse corner") {
    const std::vector<float> a = areas({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {-1, 1, 0}});
    CHECK(std::abs(a[0] - 0.25f) < 1e-6f);
    CHECK(std::abs(a[1] - 0.125f) < 1e-6f);
    CHECK(std::abs(a[2] - 0.125f) < 1e-6f);
  }
  SECTION("the Voronoi cell of a lattice point is its square") {
    // 4 squares of 1 x 1, each cut along a diagonal; the centre's cell is 1.
    std::vector<Vec3> p;
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 3; ++x) p.push_back({static_cast<float>(x), static_cast<float>(y), 0});
    Triangles t;
    for (std::uint32_t y = 0; y < 2; ++y)
      for (std::uint32_t x = 0; x < 2; ++x) {
        const std::uint32_t a = 3 * y + x;
        t.push_back({a, a + 1, a + 4});
        t.push_back({a, a + 4, a + 3});
      }
    const std::vector<float> a = areas(t, p);
    CHECK(std::abs(a[4] - 1) < 1e-6f);
    float sum = 0;
    for (const float v : a) sum += v;
    CHECK(std::abs(sum - 4) < 1e-5f);
  }
  SECTION("a degenerate triangle adds nothing") {
    for (const float a : areas({{0, 1, 2}}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}})) CHECK(a == 0);
  }
}
