// Damaged and hostile files: each is refused with a message that names its fault, and none crashes.
#include <filesystem>
#include <random>

#include "sdk/src/core/failure.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

std::string failure_of(const std::vector<std::byte>& bytes) {
  try {
    import_gltf(bytes);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
    return failure.what();
  }
  return "";
}

// Binary and text: the same fault must be found in both.
void check_refused(const GltfBuilder& file, const std::string& part) {
  for (const auto& bytes : {file.glb(), file.gltf()}) {
    const std::string message = failure_of(bytes);
    INFO(message);
    CHECK(message.find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("files that are missing, empty, folders or something else") {
  CHECK_THROWS_AS(import_gltf(std::filesystem::path("no/such/file.glb")), Failure);
  CHECK_THROWS_AS(import_gltf(std::filesystem::temp_directory_path()), Failure);
  CHECK(failure_of({}).find("empty") != std::string::npos);
  CHECK(failure_of(GltfBuilder::bytes_of("this is no glTF")).find("not a glTF 2.0 file") !=
        std::string::npos);
  CHECK(failure_of(GltfBuilder::bytes_of("{}")).find("no asset.version") != std::string::npos);
  std::vector<std::byte> old_version = tube_file().glb();
  old_version[4] = std::byte{1};
  CHECK(failure_of(old_version).find("the binary header says that the file has glTF version 1 (need 2)") !=
        std::string::npos);
}

TEST_CASE("a binary file cut anywhere is refused") {
  const std::vector<std::byte> whole = tube_file().glb();
  for (std::size_t size = 0; size < whole.size(); size += 37) {
    INFO(size);
    // A copy of its own size, so that a read past the end is seen by the sanitizer.
    CHECK(
        !failure_of(std::vector<std::byte>(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)))
             .empty());
  }
}

TEST_CASE("external files, which cannot be read") {
  CHECK(!failure_of(tube_file().gltf("/etc/hostname")).empty());
  CHECK(!failure_of(tube_file().gltf("tube.bin")).empty());
}

TEST_CASE("JSON nested without end is refused") {
  std::string deep = R"({"asset":{"version":"2.0","extras":)";
  for (int i = 0; i < 100000; ++i) deep += '[';
  CHECK(failure_of(GltfBuilder::bytes_of(deep)).find("nested") != std::string::npos);
}

TEST_CASE("faults of the mesh") {
  Tube tube;
  SECTION("a position that is not finite") {
    tube.position[3 * 7 + 1] = NAN;
    tube.position[3 * 9] = INFINITY;
    check_refused(tube_file(tube),
                  "position that is not finite or beyond 1e6 m: 2 of 47, the first has index 7");
  }
  SECTION("a position that no model can hold") {
    tube.position[3 * 8] = 1e18f;
    check_refused(tube_file(tube), "beyond 1e6 m: 1 of 47, the first has index 8");
  }
  SECTION("a scale that takes the mesh further than a model can hold") {
    GltfBuilder file = tube_file();
    file.document["nodes"][0]["scale"] = {1e7, 1e7, 1e7};
    check_refused(file, "the joint of bone 1 (\"tip\") is out of range (got 0 1e+07 0");
  }
  SECTION("weights that are all zero") {
    for (int k = 0; k < 4; ++k) tube.weight[4 * 5 + k] = 0;
    check_refused(tube_file(tube), "1 of 47 skinned vertices have no weights (need at most 1 %)");
  }
  SECTION("a weight that is not finite") {
    tube.weight[6] = NAN;
    check_refused(tube_file(tube), "vertex 1 has a weight that is not finite");
  }
  SECTION("an index out of range") {
    tube.index[10] = 60000;
    check_refused(tube_file(tube), "index 60000, but only 47 vertices");
  }
  SECTION("a list that is not made of threes") {
    tube.index.pop_back();
    check_refused(tube_file(tube), "need three per triangle");
  }
  SECTION("a joint out of range") {
    tube.joint[4 * 3] = 2;
    check_refused(tube_file(tube), "vertex 3 refers to joint 2, but the skin has only 2");
  }
  SECTION("no triangles") {
    GltfBuilder file = tube_file();
    file.document["meshes"][0]["primitives"][0]["mode"] = 0;
    check_refused(file, "no triangles");
  }
  SECTION("triangles without area only") {
    tube.index = {0, 0, 1};
    check_refused(tube_file(tube), "no triangles: all 1 have no area");
  }
  SECTION("no weights") {
    GltfBuilder file = tube_file();
    file.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    check_refused(file, "only one of JOINTS_0 and WEIGHTS_0");
  }
  SECTION("no joints and no weights") {
    GltfBuilder file = tube_file();
    Json& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    attributes = {{"POSITION", attributes["POSITION"]}};
    check_refused(file, "has a skin but no JOINTS_0");
  }
  SECTION("no positions") {
    GltfBuilder file = tube_file();
    file.document["meshes"][0]["primitives"][0]["attributes"].erase("POSITION");
    check_refused(file, "has no POSITION");
  }
  SECTION("weights for another number of vertices") {
    GltfBuilder file = tube_file();
    file.document["accessors"][2]["count"] = 46;
    check_refused(file, "46 weights for 47 vertices");
  }
}

TEST_CASE("a scene without a mesh") {
  GltfBuilder file = tube_file();
  file.document["nodes"][3].erase("skin");
  file.document.erase("animations");
  file.document["nodes"][3].erase("mesh");
  check_refused(file, "no triangles: the scene shows no mesh");
}

TEST_CASE("faults of accessors and buffer views") {
  GltfBuilder file = tube_file();
  Json& accessor = file.document["accessors"][0];
  SECTION("more elements than bytes") {
    accessor["count"] = 48;
    check_refused(file, "do not fit");
  }
  SECTION("far more elements than bytes") {
    accessor["count"] = 4000000000u;
    check_refused(file, "too many vertices (need at most 10000000)");
  }
  SECTION("no bytes at all, and many elements") {
    accessor.erase("bufferView");
    accessor["count"] = 4000000000u;
    check_refused(file, "need at most");
  }
  SECTION("an offset behind the view") {
    accessor["byteOffset"] = 100000;
    check_refused(file, "do not fit");
  }
  SECTION("a view behind its buffer") {
    file.document["bufferViews"][0]["byteOffset"] = 100000;
    check_refused(file, "buffer");
  }
  SECTION("a view that wraps around") {
    file.document["bufferViews"][0]["byteLength"] = 18446744073709551615u;
    check_refused(file, "");
  }
  SECTION("a stride smaller than an element") {
    file.document["bufferViews"][0]["byteStride"] = 4;
    check_refused(file, "stride");
  }
  SECTION("a view that is not there") {
    accessor["bufferView"] = 99;
    check_refused(file, "buffer view 99");
  }
  SECTION("an accessor that is not there") {
    file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 99;
    check_refused(file, "accessor 99");
  }
  SECTION("indices in an accessor that is not there") {
    file.document["meshes"][0]["primitives"][0]["indices"] = 99;
    check_refused(file, "");
  }
  SECTION("another type") {
    accessor["type"] = "VEC4";
    check_refused(file,
                  "POSITION (accessor 0) contains VEC4 of FLOAT (need VEC3; allowed component types: FLOAT)");
  }
  SECTION("sparse values beyond the elements") {
    accessor["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", file.add_view(std::vector<std::uint16_t>{47})}, {"componentType", 5123}}},
        {"values", {{"bufferView", file.add_view(std::vector<float>{0, 0, 0})}}}};
    check_refused(file, "sparse index is 47");
  }
  SECTION("more sparse values than bytes") {
    file.document["accessors"][0]["sparse"] = {
        {"count", 40},
        {"indices", {{"bufferView", file.add_view(std::vector<std::uint16_t>{0})}, {"componentType", 5123}}},
        {"values", {{"bufferView", file.add_view(std::vector<float>{0, 0, 0})}}}};
    check_refused(file, "do not fit");
  }
}

TEST_CASE("faults of nodes") {
  GltfBuilder file = tube_file();
  Json& nodes = file.document["nodes"];
  SECTION("a cycle") {
    nodes[2]["children"] = Json::array({0});
    check_refused(file, "cycle");
  }
  SECTION("two parents") {
    nodes[2]["children"] = Json::array({3});
    check_refused(file, "two parents");
  }
  SECTION("a child that is not there") {
    nodes[2]["children"] = Json::array({17});
    check_refused(file, "refers to node 17 as a child");
  }
  SECTION("a mesh that is not there") {
    nodes[3]["mesh"] = 5;
    check_refused(file, "mesh 5");
  }
  SECTION("a skin that is not there") {
    nodes[3]["skin"] = 5;
    check_refused(file, "skin 5");
  }
  SECTION("a zero quaternion") {
    nodes[2]["rotation"] = {0, 0, 0, 0};
    check_refused(file, "a rotation of length 0");
  }
  SECTION("a scale of zero above the skeleton") {
    nodes[0]["scale"] = {0, 1, 1};
    check_refused(file, "singular");
  }
  SECTION("transforms that overflow") {
    nodes[0]["scale"] = {1e300, 1e300, 1e300};
    nodes[1]["scale"] = {1e300, 1e300, 1e300};
    check_refused(file, "not finite");
  }
  SECTION("a scene that is not there") {
    file.document["scene"] = 4;
    check_refused(file, "scene");
  }
  SECTION("a scene with a node that is not there") {
    file.document["scenes"][0]["nodes"] = Json::array({44});
    check_refused(file, "node 44");
  }
  SECTION("an endless chain") {
    for (int i = 0; i < 5000; ++i) {
      nodes.back()["children"] = Json::array({nodes.size()});
      nodes.push_back(Json::object());
    }
    check_refused(file, "nested deeper");
  }
}

TEST_CASE("faults of skins") {
  GltfBuilder file = tube_file();
  Json& skin = file.document["skins"][0];
  SECTION("no joints") {
    skin["joints"] = Json::array();
    check_refused(file, "joints");
  }
  SECTION("a joint that is not there") {
    skin["joints"] = {1, 12};
    check_refused(file, "refers to node 12 as a joint");
  }
  SECTION("too few inverse bind matrices") {
    file.document["accessors"][4]["count"] = 1;
    check_refused(file, "1 inverse bind matrices for 2 joints");
  }
  SECTION("a singular inverse bind matrix") {
    skin["inverseBindMatrices"] = file.add_floats(std::vector<float>(32, 0.0f), "MAT4");
    check_refused(file, "singular");
  }
  SECTION("more joints than a bone index can say") {
    Json joints = Json::array();
    for (int i = 0; i < 65536; ++i) {
      joints.push_back(file.document["nodes"].size());
      file.document["nodes"].push_back(Json::object());
    }
    skin = {{"joints", joints}};
    check_refused(file, "too many joints (got 65536, need at most 65535)");
  }
}

TEST_CASE("faults of clips") {
  GltfBuilder file = tube_file();
  file.add_animation("broken");
  SECTION("fewer values than keys") {
    file.add_channel(2, "translation", {0, 1}, {0, 0, 0});
    check_refused(file, "clip \"broken\" channel 0 has 1 values for 2 keys");
  }
  SECTION("times that go back") {
    file.add_channel(2, "translation", {1, 0}, {0, 0, 0, 0, 0, 0});
    check_refused(file, "key times that decrease");
  }
  SECTION("a key that is not finite") {
    file.add_channel(2, "translation", {0}, {0, INFINITY, 0});
    check_refused(file, "not finite");
  }
  SECTION("a key beyond any world") {
    file.add_channel(2, "translation", {0}, {0, 1e20f, 0});
    check_refused(file, "moves bone 1 (\"tip\") beyond 1e9 m");
  }
  SECTION("a node that is not there") {
    file.add_channel(55, "translation", {0}, {0, 0, 0});
    check_refused(file, "node 55");
  }
  SECTION("a sampler that is not there") {
    file.add_channel(2, "translation", {0}, {0, 0, 0});
    file.document["animations"][1]["channels"][0]["sampler"] = 3;
    check_refused(file, "sampler 3");
  }
  SECTION("an unknown interpolation") {
    file.add_channel(2, "translation", {0}, {0, 0, 0}, "BEZIER");
    check_refused(file, "BEZIER");
  }
  SECTION("a node with a matrix") {
    file.document["nodes"][2] = {{"matrix", translation_columns(0, 1, 0)}};
    file.add_channel(2, "translation", {0}, {0, 0, 0});
    check_refused(file, "has a matrix");
  }
}

#if !NOOK_DRACO
TEST_CASE("compressed meshes are refused by name") {
  GltfBuilder file = tube_file();
  file.document["extensionsUsed"] = Json::array({"KHR_draco_mesh_compression"});
  file.document["extensionsRequired"] = Json::array({"KHR_draco_mesh_compression"});
  check_refused(file, "KHR_draco_mesh_compression");
}
#endif

TEST_CASE("flipped bytes either load or are refused") {
  const std::vector<std::byte> whole = tube_file().glb();
  std::mt19937 random(1);  // the same flips every time
  int refused = 0;
  for (int round = 0; round < 300; ++round) {
    std::vector<std::byte> bytes = whole;
    const int flips = 1 + round % 3;
    for (int i = 0; i < flips; ++i)
      bytes[random() % bytes.size()] ^= static_cast<std::byte>(1 + random() % 255);
    try {
      const ImportedCharacter character = import_gltf(bytes);
      CHECK(character.mesh.vertex_count() > 0);
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
      ++refused;
    }
  }
  // Three quarters of the bytes are JSON, where few flips are harmless.
  CHECK(refused > 30);
}
