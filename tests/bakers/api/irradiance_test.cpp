#include <cmath>
#include <limits>
#include <vector>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"

namespace {

constexpr float pi = 3.14159265f;

// A square overhead under a sky of constant radiance, seen by receivers at the origin.
struct Lighting {
  float positions[12] = {-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
  std::uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
  float sky[3] = {1, 2, 4};
  nook_bake_lit_mesh mesh{positions, indices, 4, 6, {0, 0, 0}, {0, 0, 0}};
  std::vector<float> points{0, 0, 0}, normals{0, 1, 0}, irradiance;
  nook_bake_irradiance_desc desc;

  Lighting() {
    nook_bake_irradiance_desc_init(&desc);
    desc.meshes = &mesh;
    desc.mesh_count = 1;
    desc.environment = {sky, 1, 1};
    desc.rays = 4096;
  }
  nook_result trace() {
    desc.positions = points.data();
    desc.normals = normals.data();
    desc.point_count = std::uint32_t(points.size() / 3);
    irradiance.assign(points.size(), -1.0f);
    return nook_bake_trace_irradiance(&desc, irradiance.data(), desc.point_count);
  }
};

// Returns the irradiance of a square of half side 1 at height 2 above a point that faces it.
float form_factor() {
  const float x = 0.5f, root = std::sqrt(1 + x * x);
  return 4 / (2 * pi) * 2 * x / root * std::atan(x / root);
}

}  // namespace

TEST_CASE("irradiance under a black square and under one that shines") {
  Lighting lighting;
  REQUIRE(lighting.trace() == NOOK_OK);
  // 4,096 paths: standard error of a form factor below 0.007, times pi.
  CHECK(std::fabs(lighting.irradiance[0] / pi - (1 - form_factor())) < 0.03f);
  CHECK(std::fabs(lighting.irradiance[2] / (4 * pi) - (1 - form_factor())) < 0.03f);
  for (float& channel : lighting.mesh.emission) channel = 1;
  lighting.desc.environment = {nullptr, 0, 0};
  REQUIRE(lighting.trace() == NOOK_OK);
  CHECK(std::fabs(lighting.irradiance[1] / pi - form_factor()) < 0.03f);
  lighting.desc.mesh_count = 0;
  REQUIRE(lighting.trace() == NOOK_OK);
  CHECK(lighting.irradiance[1] == 0);
}

TEST_CASE("irradiance does not depend on the number of threads") {
  Lighting lighting;
  lighting.desc.rays = 8;
  lighting.points.clear();
  lighting.normals.clear();
  for (int i = 0; i < 2000; ++i) {
    lighting.points.insert(lighting.points.end(), {0.001f * float(i), 0, 0});
    lighting.normals.insert(lighting.normals.end(), {0, 1, 0});
  }
  lighting.desc.threads = 1;
  REQUIRE(lighting.trace() == NOOK_OK);
  const std::vector<float> one = lighting.irradiance;
  lighting.desc.threads = 2;
  REQUIRE(lighting.trace() == NOOK_OK);
  CHECK(one == lighting.irradiance);
}

TEST_CASE("lighting that makes no sense is refused") {
  Lighting lighting;
  const char* expected = "";
  SECTION("base colour") {
    lighting.mesh.base_colour[1] = 1.5f;
    expected = "desc.meshes[0].base_colour is out of range (got 1.5";
  }
  SECTION("emission") {
    lighting.mesh.emission[0] = std::numeric_limits<float>::infinity();
    expected = "desc.meshes[0].emission is out of range";
  }
  SECTION("index out of range") {
    lighting.indices[4] = 4;
    expected = "desc.meshes[0] has an index out of range (got 4";
  }
  SECTION("a map without height") {
    lighting.desc.environment.height = 0;
    expected = "desc.environment has 1 x 0 texels";
  }
  SECTION("a map without texels") {
    lighting.desc.environment.rgb = nullptr;
    expected = "desc.environment.rgb is NULL";
  }
  SECTION("a map that is not finite") {
    lighting.sky[2] = std::nanf("");
    expected = "texel of the environment is out of range (got nan in row 0, column 0";
  }
  SECTION("a map so bright that sums of its light have no float") {
    lighting.sky[1] = 1e37f;
    expected = "texel of the environment is out of range (got 1e+37 in row 0, column 0, need 0 to 1e+15)";
  }
  SECTION("emission so bright") {
    lighting.mesh.emission[2] = 1e37f;
    expected = "desc.meshes[0].emission is out of range (got 1e+37, need 0 to 1e+15)";
  }
  SECTION("no rays") {
    lighting.desc.rays = 0;
    expected = "desc.rays is out of range";
  }
  // Finite numbers that Embree would end the process for.
  SECTION("a point beyond any scene") {
    lighting.points[1] = 1e19f;
    expected = "desc.positions is out of range at point 0 (got 0 1e+19";
  }
  SECTION("an offset beyond any scene") {
    lighting.desc.origin_offset = 1e30f;
    expected = "desc.origin_offset is out of range (got 1e+30";
  }
  SECTION("a normal of another length") {
    lighting.normals = {0, 2, 0};
    expected = "not of unit length at point 0 (got 2)";
  }
  CHECK(lighting.trace() == NOOK_ERROR_INVALID_ARGUMENT);
  INFO(nook_bake_last_message());
  CHECK(message_has(expected));
  CHECK(lighting.irradiance[0] == -1);
  CHECK(nook_bake_trace_irradiance(&lighting.desc, lighting.irradiance.data(), 9) ==
        NOOK_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("the brightest light that is taken has finite irradiance") {
  Lighting lighting;
  std::fill(std::begin(lighting.sky), std::end(lighting.sky), 0.99e15f);
  REQUIRE(lighting.trace() == NOOK_OK);
  for (const float e : lighting.irradiance) CHECK(std::isfinite(e));
  CHECK(lighting.irradiance[0] > 1e14f);
}
