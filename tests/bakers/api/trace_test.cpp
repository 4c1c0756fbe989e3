#include <cmath>
#include <limits>
#include <vector>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"

namespace {

// A square in a plane of constant y, half its side long in each direction.
struct Square {
  float positions[12];
  std::uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
  Square(float half, float y) : positions{-half, y, -half, half, y, -half, half, y, half, -half, y, half} {}
  nook_bake_occluder_mesh mesh() const { return {positions, indices, 4, 6}; }
};

struct Scene {
  nook_bake_trace_desc desc;
  std::vector<nook_bake_occluder_mesh> meshes;
  std::vector<float> positions{0, 0, 0}, normals{0, 1, 0};

  Scene() { nook_bake_trace_desc_init(&desc); }
  nook_result trace(std::vector<float>& ao) {
    desc.meshes = meshes.data();
    desc.mesh_count = std::uint32_t(meshes.size());
    desc.positions = positions.data();
    desc.normals = normals.data();
    desc.point_count = std::uint32_t(positions.size() / 3);
    ao.assign(desc.point_count, -1.0f);
    return nook_bake_trace_ao(&desc, ao.data(), desc.point_count);
  }
};

// Share of the cosine-weighted hemisphere that a square of half side a at height h above the point covers:
// four times the form factor of a quarter, each 1/(2 pi) [2 x / sqrt(1 + x^2) atan(x / sqrt(1 + x^2))] with x
// = a / h.
double square_form_factor(double a, double h) {
  const double x = a / h, root = std::sqrt(1 + x * x);
  return 4 / (2 * 3.14159265358979) * 2 * x / root * std::atan(x / root);
}

}  // namespace

TEST_CASE("a square overhead darkens by its form factor") {
  const Square square(1, 2);
  Scene scene;
  scene.meshes = {square.mesh()};
  scene.desc.rays = 4096;
  std::vector<float> ao;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  // 4,096 stratified rays: the standard deviation is below that of independent ones, sqrt(f (1 - f) / 4096) =
  // 0.0067.
  CHECK(std::fabs(double(ao[0]) - (1 - square_form_factor(1, 2))) < 0.015);
}

TEST_CASE("meshes add up, a radius ignores what is farther") {
  const Square near(1, 2), far(40, 5);
  Scene scene;
  scene.desc.rays = 1024;
  std::vector<float> ao;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  CHECK(ao[0] == 1);  // nothing there
  scene.meshes = {near.mesh(), far.mesh()};
  REQUIRE(scene.trace(ao) == NOOK_OK);
  CHECK(ao[0] <
        0.05f);  // the far one covers all but the horizon: 1 - 64/65 of cosine-weighted directions at most
  scene.desc.radius = 4.5f;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  // A ray to the near square's corner is 2.45 m long: all of it counts, and none of the far one.
  CHECK(std::fabs(double(ao[0]) - (1 - square_form_factor(1, 2))) < 0.03);
  scene.desc.radius = 1;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  CHECK(ao[0] == 1);
}

TEST_CASE("traced values do not depend on the number of threads") {
  const Square square(1, 0.7f);
  Scene scene;
  scene.meshes = {square.mesh()};
  scene.positions.clear();
  scene.normals.clear();
  for (int i = 0; i < 2000; ++i) {
    scene.positions.insert(scene.positions.end(), {0.001f * float(i), 0, 0});
    scene.normals.insert(scene.normals.end(), {0, 1, 0});
  }
  std::vector<float> one, two, other;
  scene.desc.threads = 1;
  REQUIRE(scene.trace(one) == NOOK_OK);
  scene.desc.threads = 2;
  REQUIRE(scene.trace(two) == NOOK_OK);
  CHECK(one == two);
  scene.desc.seed = 2;
  REQUIRE(scene.trace(other) == NOOK_OK);
  CHECK(one != other);
}

TEST_CASE("a scene at the limit of places is traced") {
  Square square(1, 2);
  Scene scene;
  for (int c = 0; c < 4; ++c) square.positions[3 * c] *= 1e6f;
  scene.meshes = {square.mesh()};
  scene.positions = {-1e6f, -1e6f, 1e6f};
  scene.desc.origin_offset = 1e6f;
  scene.desc.radius = 3e38f;
  std::vector<float> ao;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  CHECK(ao[0] >= 0);
}

TEST_CASE("scenes that make no sense are refused") {
  Square square(1, 2);
  Scene scene;
  scene.meshes = {square.mesh()};
  const char* expected = "";
  SECTION("index out of range") {
    square.indices[4] = 4;
    expected = "desc.meshes[0] has an index out of range (got 4";
  }
  SECTION("half a triangle") {
    scene.meshes[0].index_count = 5;
    expected = "index_count is not a multiple of 3";
  }
  SECTION("a position that is not finite") {
    square.positions[7] = std::numeric_limits<float>::infinity();
    expected = "desc.meshes[0] has vertex 2 out of range (got 1 inf 1";
  }
  SECTION("a normal of another length") {
    scene.normals = {0, 2, 0};
    expected = "not of unit length at point 0 (got 2)";
  }
  SECTION("no rays") {
    scene.desc.rays = 0;
    expected = "desc.rays is out of range";
  }
  SECTION("radius") {
    scene.desc.radius = 0;
    expected = "desc.radius is out of range";
  }
  SECTION("offset") {
    scene.desc.origin_offset = -1;
    expected = "desc.origin_offset is out of range";
  }
  SECTION("a receiver that is not finite") {
    scene.positions[1] = std::nanf("");
    expected = "desc.positions is out of range at point 0 (got 0 nan 0";
  }
  // Finite numbers that Embree would end the process for.
  SECTION("a vertex beyond any scene") {
    square.positions[6] = 1e18f;
    expected = "desc.meshes[0] has vertex 2 out of range (got 1e+18";
  }
  SECTION("a receiver beyond any scene") {
    scene.positions[0] = -1e19f;
    expected = "desc.positions is out of range at point 0 (got -1e+19";
  }
  SECTION("an offset beyond any scene") {
    scene.desc.origin_offset = 1e30f;
    expected = "desc.origin_offset is out of range (got 1e+30";
  }
  std::vector<float> ao;
  CHECK(scene.trace(ao) == NOOK_ERROR_INVALID_ARGUMENT);
  INFO(nook_bake_last_message());
  CHECK(message_has(expected));
  CHECK(ao[0] == -1);
  CHECK(nook_bake_trace_ao(&scene.desc, ao.data(), 9) == NOOK_ERROR_INVALID_ARGUMENT);
}

namespace {

struct Watch {
  int calls = 0, stop_at = 0;
  std::uint64_t done = 0, total = 0;
};

std::int32_t watch(void* user, const nook_bake_progress* progress) {
  Watch& seen = *static_cast<Watch*>(user);
  seen.done = progress->done;
  seen.total = progress->total;
  return ++seen.calls != seen.stop_at;
}

}  // namespace

TEST_CASE("tracing reports its progress, and stops without writing if the callback returns 0") {
  const Square square(1, 2);
  Scene scene;
  scene.meshes = {square.mesh()};
  scene.positions.assign(3 * 3000, 0.0f);
  scene.normals.clear();
  for (int i = 0; i < 3000; ++i) scene.normals.insert(scene.normals.end(), {0, 1, 0});
  std::vector<float> expected, ao;
  REQUIRE(scene.trace(expected) == NOOK_OK);
  Watch seen;
  scene.desc.progress = watch;
  scene.desc.progress_user = &seen;
  REQUIRE(scene.trace(ao) == NOOK_OK);
  CHECK(ao == expected);
  CHECK(seen.calls > 10);  // blocks have at most 256 points
  CHECK(seen.done == 3000);
  CHECK(seen.total == 3000);
  seen = {0, 3, 0, 0};
  CHECK(scene.trace(ao) == NOOK_ERROR_CANCELLED);
  CHECK(message_has("nook_bake_trace_ao: cancelled while ray tracing ("));
  CHECK(seen.calls == 3);
  CHECK(ao == std::vector<float>(3000, -1.0f));

  const std::vector<nook_bake_lit_mesh> lit = {
      {square.positions, square.indices, 4, 6, {0.5f, 0.5f, 0.5f}, {1, 1, 1}}};
  nook_bake_irradiance_desc light;
  REQUIRE(nook_bake_irradiance_desc_init(&light) == NOOK_OK);
  light.meshes = lit.data();
  light.mesh_count = 1;
  light.positions = scene.positions.data();
  light.normals = scene.normals.data();
  light.point_count = 3000;
  light.progress = watch;
  light.progress_user = &seen;
  std::vector<float> rgb(9000, -1.0f);
  seen = {0, 2, 0, 0};
  CHECK(nook_bake_trace_irradiance(&light, rgb.data(), 3000) == NOOK_ERROR_CANCELLED);
  CHECK(rgb == std::vector<float>(9000, -1.0f));
  seen = {};
  CHECK(nook_bake_trace_irradiance(&light, rgb.data(), 3000) == NOOK_OK);
  CHECK(seen.done == 3000);
}
