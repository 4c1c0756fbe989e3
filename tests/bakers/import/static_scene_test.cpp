// Scenes that stand still: where their triangles land, and files that are refused.
#include "tests/catch.h"

#include <filesystem>
#include <limits>

#include "bakers/import/static_scene.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/import/gltf_builder.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// A right triangle of sides 1, shown twice: by the scene's root, and below a scale of 0.5 moved up by 3.
GltfBuilder two_triangles() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  file.document["meshes"] =
      Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", position}}}}})}}});
  file.document["nodes"] =
      Json::array({{{"mesh", 0}, {"children", {1}}},
                   {{"translation", {0, 3, 0}}, {"scale", {0.5, 0.5, 0.5}}, {"children", {2}}},
                   {{"mesh", 0}},
                   {{"mesh", 0}, {"name", "not in the scene"}}});
  return file;
}

std::string failure_of(const GltfBuilder& file) {
  try {
    import_static_scene(file.glb());
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a static scene holds every shown triangle where its nodes put it") {
  const StaticScene scene = import_static_scene(two_triangles().glb());
  REQUIRE(scene.triangle.size() == 2);
  REQUIRE(scene.position.size() == 6);
  CHECK(scene.position[1] == Vec3{1, 0, 0});
  const auto& moved = scene.triangle[1];
  CHECK(scene.position[moved[0]] == Vec3{0, 3, 0});
  CHECK(scene.position[moved[1]] == Vec3{0.5f, 3, 0});
  CHECK(scene.position[moved[2]] == Vec3{0, 3.5f, 0});
}

TEST_CASE("triangles of a static scene carry their material's colours") {
  GltfBuilder file = two_triangles();
  file.document["materials"] =
      Json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {0.5, 0.25, 1.0, 1.0}}}}},
                   {{"emissiveFactor", {1.0, 0.5, 0.0}},
                    {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4.0}}}}}}});
  Json& primitives = file.document["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 0;
  primitives[1]["material"] = 1;
  const StaticScene scene = import_static_scene(file.glb());
  REQUIRE(scene.triangle_surface == std::vector<std::uint32_t>{0, 1, 2, 0, 1, 2});
  REQUIRE(scene.surface.size() == 3);
  CHECK(scene.surface[0].base_colour == Vec3{0.5f, 0.25f, 1});
  CHECK(scene.surface[0].emission == Vec3{});
  CHECK(scene.surface[1].base_colour == Vec3{1, 1, 1});  // glTF's default
  CHECK(scene.surface[1].emission == Vec3{4, 2, 0});
  CHECK(scene.surface[2].base_colour == Vec3{0.8f, 0.8f, 0.8f});

  primitives[0]["material"] = 2;
  CHECK(failure_of(file).find("refers to material 2, but the file has only 2") != std::string::npos);
  primitives[0]["material"] = 0;
  file.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"][1] = -1;
  CHECK(failure_of(file).find("material 0 has a baseColorFactor") != std::string::npos);
}

TEST_CASE("strips and indices of a static scene") {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  const int index = file.add(std::vector<unsigned short>{0, 1, 2, 3}, "SCALAR", 5123);
  Json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", index}, {"mode", 5}};
  file.document["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
  file.document["nodes"] = Json::array({{{"mesh", 0}}});
  CHECK(import_static_scene(file.glb()).triangle.size() == 2);
  file.document["meshes"][0]["primitives"][0]["mode"] = 1;  // lines alone
  CHECK(failure_of(file).find("shows no triangle") != std::string::npos);
}

TEST_CASE("static scenes that cannot be read are refused") {
  CHECK_THROWS_AS(import_static_scene(std::filesystem::path("no/such/scene.glb")), Failure);
  CHECK_THROWS_AS(import_static_scene(std::span<const std::byte>()), Failure);
  const std::vector<std::byte> whole = two_triangles().glb();
  for (std::size_t size = 0; size < whole.size(); size += 23)
    CHECK_THROWS_AS(import_static_scene(std::span(whole).first(size)), Failure);

  GltfBuilder file = two_triangles();
  file.document["nodes"][2]["mesh"] = 7;
  CHECK_FALSE(failure_of(file).empty());
  file = two_triangles();
  file.document["meshes"][0]["primitives"][0]["attributes"].erase("POSITION");
  CHECK(failure_of(file).find("no POSITION") != std::string::npos);
  file = two_triangles();
  const int index = file.add(std::vector<unsigned short>{0, 1, 9}, "SCALAR", 5123);
  file.document["meshes"][0]["primitives"][0]["indices"] = index;
  CHECK(failure_of(file).find("has index 9") != std::string::npos);
  GltfBuilder not_finite;
  const int position =
      not_finite.add_floats({0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 1, 0}, "VEC3");
  not_finite.document["meshes"] =
      Json::array({{{"primitives", Json::array({{{"attributes", {{"POSITION", position}}}}})}}});
  not_finite.document["nodes"] = Json::array({{{"mesh", 0}}});
  CHECK(failure_of(not_finite).find("vertex 1 is out of range (got nan") != std::string::npos);
  file = two_triangles();
  file.document["nodes"][2]["translation"] = {0, 1e18, 0};
  CHECK(failure_of(file).find("is out of range") != std::string::npos);
}
