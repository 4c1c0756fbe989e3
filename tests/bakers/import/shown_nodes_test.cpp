// Which nodes of a file are geometry: hidden ones, levels of detail, choices by name, and instances.
#include "tests/catch.h"

#include <algorithm>
#include <functional>

#include "bakers/import/coincident_surfaces.h"
#include "bakers/import/gltf.h"
#include "bakers/import/shown_nodes.h"
#include "bakers/import/static_scene.h"
#include "bakers/import/surface_mesh.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/import/tube_file.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

std::string failure_when(nook_result code, const std::function<void()>& import) {
  try {
    import();
  } catch (const Failure& failure) {
    CHECK(failure.code() == code);
    return failure.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Json hidden() {
  return {{"KHR_node_visibility", {{"visible", false}}}};
}

// A node of the tube's armature that shows a mesh; returns its index.
int add_node(GltfBuilder& file, const Json& node) {
  file.document["nodes"].push_back(node);
  const int index = int(file.document["nodes"].size()) - 1;
  file.document["nodes"][0]["children"].push_back(index);
  return index;
}

// A second skinned mesh with the same primitive under another name.
int add_body(GltfBuilder& file, const std::string& node, const std::string& mesh = "") {
  Json copy = file.document["meshes"][0];
  copy["name"] = mesh.empty() ? node : mesh;
  file.document["meshes"].push_back(copy);
  return add_node(file, {{"name", node}, {"mesh", file.document["meshes"].size() - 1}, {"skin", 0}});
}

// Compares all that a bake sees: vertices, triangles, weights and bones, bit for bit.
void check_equal(const ImportedCharacter& a, const ImportedCharacter& b) {
  CHECK(a.mesh.position == b.mesh.position);
  CHECK(a.mesh.triangle == b.mesh.triangle);
  CHECK(a.mesh.weights == b.mesh.weights);
  CHECK(a.mesh.file_to_welded == b.mesh.file_to_welded);
  REQUIRE(a.mesh.bones.size() == b.mesh.bones.size());
  for (std::size_t i = 0; i < a.mesh.bones.size(); ++i) CHECK(a.mesh.bones[i].name == b.mesh.bones[i].name);
}

// A unit square in the plane z = 0 shown by one node, and nodes to add to.
GltfBuilder square_scene() {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3");
  const int uv = file.add_floats({0, 0, 1, 0, 0, 1, 1, 1}, "VEC2");
  const int index = file.add(std::vector<std::uint16_t>{0, 1, 2, 2, 1, 3}, "SCALAR", 5123);
  const Json primitive = {{"attributes", {{"POSITION", position}, {"TEXCOORD_0", uv}}}, {"indices", index}};
  file.document["meshes"] = Json::array({{{"name", "square"}, {"primitives", Json::array({primitive})}}});
  file.document["nodes"] =
      Json::array({{{"name", "root"}, {"children", Json::array({1})}}, {{"name", "floor"}, {"mesh", 0}}});
  return file;
}

}  // namespace

TEST_CASE("hidden nodes and their descendants are not imported") {
  const ImportedCharacter plain = load(tube_file());
  GltfBuilder file = tube_file();
  const int hull = add_body(file, "hull");
  SECTION("the node itself") {
    file.document["nodes"][hull]["extensions"] = hidden();
  }
  SECTION("an ancestor") {
    file.document["nodes"][hull].erase("skin");
    file.document["nodes"][0]["children"].erase(2);
    file.document["nodes"].push_back({{"name", "colliders"}, {"children", {hull}}, {"extensions", hidden()}});
    file.document["nodes"][2]["children"] = {hull + 1};
  }
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    file.document[list] = {"KHR_node_visibility"};
    const ImportedCharacter shown = load(file);
    check_equal(shown, plain);
    CHECK(has_warning(shown.warnings, "1 mesh is hidden by KHR_node_visibility and was left out: \"hull\""));
    CHECK(import_static_scene(file.glb()).triangle.size() == std::size_t(Tube::triangles));
  }
}

TEST_CASE("a hidden joint still poses, and a hidden armature hides its meshes") {
  const ImportedCharacter plain = load(tube_file());
  GltfBuilder file = tube_file();
  file.document["nodes"][1]["extensions"] = hidden();
  const ImportedCharacter posed = load(file);
  check_equal(posed, plain);
  CHECK(posed.warnings == plain.warnings);
  file.document["nodes"][0]["extensions"] = hidden();
  const std::string message = failure_when(NOOK_ERROR_BAD_FILE, [&] { load(file); });
  CHECK(contains(message, "every mesh of the scene is left out: 1 hidden by KHR_node_visibility (\"body\")"));
  CHECK(failure_when(NOOK_ERROR_BAD_FILE, [&] { import_static_scene(file.glb()); }) == message);
  file.document["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = 0;
  CHECK(contains(failure_when(NOOK_ERROR_BAD_FILE, [&] { load(file); }), "visible is not true or false"));
}

TEST_CASE("nodes that are scaled to 0 are not imported") {
  GltfBuilder file = square_scene();
  file.document["nodes"].push_back({{"name", "gone"}, {"mesh", 0}, {"scale", {0, 0, 0}}});
  file.document["nodes"][0]["children"].push_back(2);
  const StaticScene scene = import_static_scene(file.glb());
  CHECK(scene.triangle.size() == 2);
  CHECK(has_warning(scene.warnings, "scaled to 0"));
}

TEST_CASE("names of levels") {
  for (const char* name : {"LOD1", "Body_LOD2", "body.lod10", "a-Lod3", "big rock lod1"})
    CHECK(level_of_name(name) > 0);
  for (const char* name : {"LOD0", "Body_LOD0"}) CHECK(level_of_name(name) == 0);
  for (const char* name : {"", "LOD", "Explod1", "LOD1_body", "reload3", "Body_LOD1x", "D1"})
    CHECK(level_of_name(name) == -1);
}

TEST_CASE("lower levels of detail are left out by name") {
  const ImportedCharacter plain = load(tube_file());
  GltfBuilder file = tube_file();
  SECTION("of a node") {
    add_body(file, "Body_LOD1", "copy");
  }
  SECTION("of a mesh") {
    add_body(file, "copy", "tube.lod2");
  }
  SECTION("of a group") {
    const int body = add_body(file, "copy");
    file.document["nodes"][0]["children"].erase(2);
    add_node(file, {{"name", "LOD1"}, {"children", Json::array({body})}});
  }
  SECTION("by MSFT_lod") {
    const int body = add_body(file, "copy");
    file.document["nodes"][3]["extensions"] = {{"MSFT_lod", {{"ids", Json::array({body})}}}};
    file.document["extensionsRequired"] = {"MSFT_lod"};
  }
  const ImportedCharacter shown = load(file);
  check_equal(shown, plain);
  CHECK(has_warning(shown.warnings, "1 mesh is a lower level of detail and was left out: "));
}

TEST_CASE("if a model has only lower levels of detail, the finest of them is imported") {
  GltfBuilder file = tube_file();
  file.document["nodes"][3]["name"] = "Body_LOD2";
  add_body(file, "Body_LOD1");
  add_body(file, "Body_LOD3");
  const ImportedCharacter shown = load(file);
  CHECK(shown.node_of_primitive == std::vector<std::uint32_t>{4});
  CHECK(has_warning(shown.warnings, "the finest level was used: \"Body_LOD1\""));
  CHECK(has_warning(shown.warnings, "2 meshes are lower levels of detail"));
}

TEST_CASE("patterns") {
  CHECK(matches_pattern("*", ""));
  CHECK(matches_pattern("Sword*", "Sword_Long"));
  CHECK_FALSE(matches_pattern("sword*", "Sword_Long"));
  CHECK(matches_pattern("*_?", "Shield_1"));
  CHECK_FALSE(matches_pattern("*_?", "Shield_12"));
  CHECK(matches_pattern("a*b*c", "aXbXbc"));
  CHECK_FALSE(matches_pattern("", "a"));
  CHECK(matches_pattern("H?lm", "H\xc3\xb6lm"));  // one letter of two bytes
  CHECK(matches_pattern("[1]", "[1]"));
}

TEST_CASE("meshes are chosen by the names of nodes and meshes") {
  const ImportedCharacter plain = load(tube_file());
  GltfBuilder file = tube_file();
  add_body(file, "Sword_Long", "blade");
  add_body(file, "Sword_Short", "knife");
  add_body(file, "Body_LOD1");
  const auto with = [&](const MeshSelection& selection) { return import_gltf(file.glb(), selection); };
  check_equal(with({{}, {"Sword*"}}), plain);
  check_equal(with({{"body"}, {}}), plain);
  check_equal(with({{"tube", "blade"}, {"Sword_*"}}), plain);
  CHECK(with({{}, {"knife"}}).node_of_primitive == std::vector<std::uint32_t>{3, 4});
  CHECK(with({{"*"}, {}}).node_of_primitive == std::vector<std::uint32_t>{3, 4, 5, 6});
  const ImportedCharacter level = with({{"*LOD1"}, {}});
  CHECK(level.node_of_primitive == std::vector<std::uint32_t>{6});
  CHECK_FALSE(has_warning(level.warnings, "the finest"));

  const auto message = [&](const MeshSelection& selection) {
    return failure_when(NOOK_ERROR_INVALID_ARGUMENT, [&] { with(selection); });
  };
  CHECK(contains(
      message({{"Axe"}, {}}),
      "is named \"Axe\", which you asked to keep (--mesh); the file has \"Body_LOD1\", \"Sword_Long\""));
  CHECK(contains(message({{}, {"body", "Axe"}}), "\"Axe\", which you asked to leave out (--without)"));
  for (int i = 0; i < 12; ++i) add_body(file, "Part" + std::to_string(i));
  CHECK(contains(message({{"Axe"}, {}}), " and 9 more"));

  file.document["nodes"][4]["extensions"] = hidden();
  const std::string refused = failure_when(NOOK_ERROR_BAD_FILE, [&] {
    import_gltf(file.glb(), {{"Sword_Long"}, {}});
  });
  CHECK(contains(refused, "1 hidden by KHR_node_visibility (\"Sword_Long\")"));
}

TEST_CASE("scenes and shapes of materials are chosen as characters are") {
  GltfBuilder file = square_scene();
  file.document["nodes"].push_back({{"name", "ceiling"}, {"mesh", 0}, {"translation", {0, 0, 1}}});
  file.document["nodes"][0]["children"].push_back(2);
  CHECK(import_static_scene(file.glb()).triangle.size() == 4);
  CHECK(import_static_scene(file.glb(), SceneTextures::skip, {{}, {"ceiling"}}).triangle.size() == 2);
  CHECK(import_surface(file.glb(), {{"floor"}, {}}).mesh.triangle.size() == 2);
  file.document["nodes"][2]["extensions"] = hidden();
  CHECK(import_surface(file.glb()).mesh.triangle.size() == 2);
}

TEST_CASE("instances of a mesh have the same positions as separate nodes would have") {
  // A quarter turn about z, as shorts and as floats: 32767 / 32767 * sqrt(1/2) rounds to 23170.
  const float h = std::sqrt(0.5f);
  const std::vector<float> at = {2, 0, 0, 0, 3, 0}, scale = {1, 1, 1, 2, 2, 2},
                           turn = {0, 0, 0, 1, 0, 0, h, h};
  const bool is_required = GENERATE(false, true);
  GltfBuilder file = square_scene(), plain = square_scene();
  file.document["nodes"][0]["translation"] = plain.document["nodes"][0]["translation"] = {0, 0, 5};
  const bool shorts = GENERATE(false, true);
  const int rotation =
      shorts ? file.add(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 23170, 23170}, "VEC4", 5122, true)
             : file.add_floats(turn, "VEC4");
  file.document["nodes"][1]["extensions"] = {{"EXT_mesh_gpu_instancing",
                                              {{"attributes",
                                                {{"TRANSLATION", file.add_floats(at, "VEC3")},
                                                 {"ROTATION", rotation},
                                                 {"SCALE", file.add_floats(scale, "VEC3")}}}}}};
  file.document[is_required ? "extensionsRequired" : "extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
  plain.document["nodes"][1]["translation"] = {2, 0, 0};
  plain.document["nodes"].push_back(
      {{"mesh", 0}, {"translation", {0, 3, 0}}, {"scale", {2, 2, 2}}, {"rotation", {0, 0, h, h}}});
  plain.document["nodes"][0]["children"].push_back(2);

  const StaticScene one = import_static_scene(file.glb()), other = import_static_scene(plain.glb());
  REQUIRE(one.position.size() == 8);
  CHECK(one.triangle == other.triangle);
  for (std::size_t v = 0; v < 8; ++v) CHECK(distance(one.position[v], other.position[v]) < 1e-5f);
  CHECK(import_surface(file.glb()).mesh.triangle.size() == 4);
  // As a prop, whose parts turn about the root.
  const ImportedCharacter prop = load(file), nodes = load(plain);
  REQUIRE(prop.mesh.file_to_welded.size() == 8);
  for (std::size_t v = 0; v < 8; ++v)
    CHECK(distance(prop.mesh.position[prop.mesh.file_to_welded[v]],
                   nodes.mesh.position[nodes.mesh.file_to_welded[v]]) < 1e-5f);
  CHECK(prop.mesh.primitives.size() == 2);
  CHECK(prop.node_of_primitive == std::vector<std::uint32_t>{1, 1});
}

TEST_CASE("instances that cannot be read are refused by name") {
  GltfBuilder file = square_scene();
  Json& attributes = file.document["nodes"][1]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  const auto message = [&] {
    return failure_when(NOOK_ERROR_BAD_FILE, [&] { import_static_scene(file.glb()); });
  };
  attributes["TRANSLATION"] = file.add_floats({0, 0, 0, 1, 1, 1}, "VEC3");
  CHECK(message() == "");
  attributes["SCALE"] = file.add_floats({1, 1, 1}, "VEC3");
  CHECK(contains(message(),
                 "node 1 (\"floor\"): EXT_mesh_gpu_instancing has attributes for 2 and for 1 instances"));
  attributes["SCALE"] = 99;
  CHECK(contains(message(), "EXT_mesh_gpu_instancing.SCALE refers to accessor 99"));
  attributes.erase("SCALE");
  attributes["ROTATION"] = file.add_floats({0, 0, 0, 1, 0, 0, 0, 0}, "VEC4");
  CHECK(contains(message(), "instance 1 has a transform that is not finite, or a rotation of length 0"));
  attributes.erase("ROTATION");
  // An accessor without a buffer view holds zeros and costs nothing.
  file.document["accessors"].push_back({{"componentType", 5126}, {"count", 3'000'000}, {"type", "VEC3"}});
  attributes["TRANSLATION"] = file.document["accessors"].size() - 1;
  CHECK(contains(message(), "repeats its mesh too often: 3000000 instances of 4 vertices"));

  GltfBuilder tube = tube_file();
  tube.document["nodes"][3]["extensions"] = {
      {"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", tube.add_floats({0, 0, 0}, "VEC3")}}}}}};
  CHECK(contains(failure_when(NOOK_ERROR_BAD_FILE, [&] { load(tube); }), "repeats a mesh with a skin"));
}

namespace {

// A tube of `sides` sides about +y with a radius that swings along it, as limbs do.
void add_tube_mesh(GltfBuilder& file, const std::string& name, int sides, int rings, float radius,
                   float from = 0, float to = 1) {
  std::vector<float> position;
  std::vector<std::uint16_t> index;
  for (int r = 0; r <= rings; ++r)
    for (int s = 0; s < sides; ++s) {
      const float y = from + (to - from) * float(r) / float(rings),
                  angle = float(2 * M_PI) * float(s) / float(sides);
      const float at = radius * (1 + 0.3f * std::sin(12 * y));
      position.insert(position.end(), {at * std::cos(angle), 2 * y, at * std::sin(angle)});
      if (r == rings) continue;
      const int a = r * sides + s, b = r * sides + (s + 1) % sides;
      for (const int i : {a, a + sides, b, b, a + sides, b + sides}) index.push_back(std::uint16_t(i));
    }
  const Json primitive = {{"attributes", {{"POSITION", file.add_floats(position, "VEC3")}}},
                          {"indices", file.add(index, "SCALAR", 5123)}};
  file.document["meshes"].push_back({{"name", name + " mesh"}, {"primitives", Json::array({primitive})}});
  file.document["nodes"].push_back({{"name", name}, {"mesh", file.document["meshes"].size() - 1}});
  file.document["scenes"][0]["nodes"].push_back(file.document["nodes"].size() - 1);
}

GltfBuilder empty_scene() {
  GltfBuilder file;
  file.document["scenes"][0]["nodes"] = Json::array();
  return file;
}

std::size_t coincident(const GltfBuilder& file) {
  const StaticScene scene = import_static_scene(file.glb());
  return std::size_t(std::count_if(scene.warnings.begin(), scene.warnings.end(),
                                   [](const std::string& text) { return contains(text, " coincide on "); }));
}

}  // namespace

TEST_CASE("levels of detail and copies without names for it are found") {
  GltfBuilder file = empty_scene();
  add_tube_mesh(file, "body", 32, 40, 0.3f);
  CHECK(coincident(file) == 0);
  SECTION("a coarser mesh") {
    add_tube_mesh(file, "second", 15, 17, 0.3f);
  }
  SECTION("a copy") {
    add_tube_mesh(file, "second", 32, 40, 0.3f);
  }
  SECTION("every second vertex of it") {
    add_tube_mesh(file, "second", 16, 20, 0.3f);
  }
  REQUIRE(coincident(file) == 1);
  CHECK(has_warning(import_static_scene(file.glb()).warnings, "--without \"second\""));
  CHECK(coincident(file) == 1);
  const StaticScene cured = import_static_scene(file.glb(), SceneTextures::skip, {{}, {"second"}});
  CHECK(cured.warnings.empty());
}

TEST_CASE("a level of detail of many parts is found") {
  GltfBuilder file = empty_scene();
  add_tube_mesh(file, "body", 15, 17, 0.303f);
  add_tube_mesh(file, "legs", 32, 20, 0.3f, 0, 0.3f);
  add_tube_mesh(file, "chest", 32, 20, 0.3f, 0.3f, 1);
  CHECK(coincident(file) == 2);
}

TEST_CASE("clothes, linings and neighbours do not lie on each other") {
  GltfBuilder file = empty_scene();
  add_tube_mesh(file, "body", 32, 40, 0.3f);
  SECTION("a tight cloth") {
    add_tube_mesh(file, "shirt", 32, 20, 0.305f, 0.3f, 0.8f);
  }
  SECTION("a suit all over") {
    add_tube_mesh(file, "suit", 31, 39, 0.306f);
  }
  SECTION("the next part") {
    add_tube_mesh(file, "head", 32, 10, 0.3f, 1, 1.3f);
  }
  SECTION("the same surface from inside") {
    // Rings from the top down reverse the triangles, which have no normals that say otherwise.
    add_tube_mesh(file, "lining", 32, 40, 0.3f, 1, 0);
  }
  CHECK(coincident(file) == 0);
}

TEST_CASE("hulls that draw outlines are found, and linings and rooms are not") {
  GltfBuilder file = empty_scene();
  add_tube_mesh(file, "body", 32, 40, 0.3f);
  std::size_t hulls = 0;
  const char* named = "\"hull\" closely surrounds";
  SECTION("around one body") {
    add_tube_mesh(file, "hull", 32, 40, 0.306f, 1, 0);
    hulls = 1;
  }
  SECTION("coarser, around two bodies") {
    add_tube_mesh(file, "head", 32, 20, 0.3f, 1, 1.6f);
    add_tube_mesh(file, "hull", 24, 50, 0.31f, 1.6f, 0);
    hulls = 1;
    named = "of node \"body\"";
  }
  SECTION("around a part") {
    add_tube_mesh(file, "sock", 32, 10, 0.306f, 0.3f, 0);
  }
  SECTION("a lining below a cloth") {
    add_tube_mesh(file, "lining", 32, 40, 0.306f, 1, 0);
    add_tube_mesh(file, "cloth", 32, 40, 0.309f);
    // One mesh, as an exporter joins them.
    Json& meshes = file.document["meshes"];
    meshes[1]["primitives"].push_back(meshes[2]["primitives"][0]);
    file.document["scenes"][0]["nodes"] = {0, 1};
  }
  SECTION("as a primitive of the body") {
    add_tube_mesh(file, "hull", 32, 40, 0.306f, 1, 0);
    Json& meshes = file.document["meshes"];
    meshes[0]["primitives"].push_back(meshes[1]["primitives"][0]);
    file.document["scenes"][0]["nodes"] = {0};
    hulls = 1;
    named = "primitive 1 of node \"body\" closely surrounds";
  }
  SECTION("a room") {
    add_tube_mesh(file, "room", 32, 40, 0.6f, 1, 0);
  }
  const std::vector<std::string> warnings = import_static_scene(file.glb()).warnings;
  CHECK(std::size_t(std::count_if(warnings.begin(), warnings.end(), [](const std::string& text) {
          return contains(text, "its faces turned inwards");
        })) == hulls);
  if (hulls > 0) CHECK(has_warning(warnings, named));
  CHECK(coincident(file) == 0);
}

TEST_CASE("where nodes share a name, the names of their meshes replace it") {
  GltfBuilder file = empty_scene();
  add_tube_mesh(file, "body", 32, 40, 0.3f);
  add_tube_mesh(file, "copy", 16, 20, 0.3f);
  file.document["nodes"][1]["name"] = "body";
  CHECK(has_warning(import_static_scene(file.glb()).warnings, "--without \"copy mesh\""));
  file.document["meshes"][1]["name"] = "body mesh";
  CHECK(has_warning(import_static_scene(file.glb()).warnings, "a unique name"));
}
