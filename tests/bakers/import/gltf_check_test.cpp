// Faults by the specification are refused by name, or repaired with a warning.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bakers/import/gltf_types.h"
#include "bakers/import/static_scene.h"
#include "bakers/import/surface_mesh.h"
#include "tests/bakers/import/refused_file.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace fs = std::filesystem;

namespace {

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  CHECK(text.find(part) != std::string::npos);
  return text.find(part) != std::string::npos;
}

// The number of warnings that contain a part.
std::size_t warnings_with(const GltfBuilder& file, const std::string& part) {
  const std::vector<std::string> warnings = load(file).warnings;
  return std::size_t(std::count_if(warnings.begin(), warnings.end(), [&](const std::string& text) {
    return text.find(part) != std::string::npos;
  }));
}

// A tube of more rings: enough vertices that one is less than 1 %.
Tube long_tube(std::size_t unused) {
  Tube tube;
  for (std::size_t i = 0; i < unused; ++i) {
    tube.position.insert(tube.position.end(), {0, float(i) / float(unused), 0});
    tube.joint.insert(tube.joint.end(), {1, 0, 0, 0});
    tube.weight.insert(tube.weight.end(), {1, 0, 0, 0});
  }
  return tube;
}

}  // namespace

TEST_CASE("versions of glTF other than 2 are refused by their number") {
  GltfBuilder file = tube_file();
  Json& asset = file.document["asset"];
  for (const Json& version : {Json("3.0"), Json("1.0"), Json("1.1"), Json(1.0), Json("2.0beta"), Json("-2.0"),
                              Json("two"), Json::array()}) {
    asset["version"] = version;
    contains(failure_of(file), "the file has glTF version " + version.dump());
    contains(failure_when([&] { import_static_scene(file.glb()); }), "glTF version " + version.dump());
  }
  asset["version"] = "2.1";
  CHECK(failure_of(file) == "");
  asset["minVersion"] = "2.0";
  CHECK(failure_of(file) == "");
  for (const char* version : {"2.1", "3.0", "1.0", "x"}) {
    asset["minVersion"] = version;
    contains(failure_of(file), std::string("asks for a reader of glTF version \"") + version);
  }
  file.document.erase("asset");
  contains(failure_of(file), "no asset.version");
  std::vector<std::byte> glb = tube_file().glb();
  glb[4] = std::byte{1};
  contains(failure_when([&] { import_gltf(glb); }), "binary header says that the file has glTF version 1");
}

TEST_CASE("accessors have the types that the specification allows") {
  GltfBuilder file = tube_file();
  const Tube tube;
  Json& primitive = file.document["meshes"][0]["primitives"][0];
  const auto floats = [](const auto& values) { return std::vector<float>(values.begin(), values.end()); };
  SECTION("indices") {
    primitive["indices"] = file.add_floats(floats(tube.index), "SCALAR");
    contains(failure_of(file),
             "mesh 0 primitive 0.indices (accessor 7) contains SCALAR of FLOAT (need SCALAR; allowed "
             "component types: "
             "UNSIGNED_BYTE, UNSIGNED_SHORT, UNSIGNED_INT)");
    contains(failure_when([&] { import_static_scene(file.glb()); }), "(accessor 7) contains SCALAR of FLOAT");
    primitive["indices"] = file.add(tube.index, "SCALAR", 5122);
    contains(failure_of(file), "contains SCALAR of SHORT");
  }
  SECTION("joints") {
    primitive["attributes"]["JOINTS_0"] = file.add_floats(floats(tube.joint), "VEC4");
    contains(failure_of(file), "mesh 0 primitive 0.JOINTS_0 (accessor 7) contains VEC4 of FLOAT");
    primitive["attributes"]["JOINTS_0"] =
        file.add(std::vector<std::uint32_t>(tube.joint.begin(), tube.joint.end()), "VEC4", 5125);
    contains(
        failure_of(file),
        "contains VEC4 of UNSIGNED_INT (need VEC4; allowed component types: UNSIGNED_BYTE, UNSIGNED_SHORT)");
    primitive["attributes"]["JOINTS_0"] = file.add(tube.joint, "VEC4", 5121, true);
    contains(failure_of(file), "contains VEC4 of normalized UNSIGNED_BYTE");
  }
  SECTION("weights") {
    primitive["attributes"]["WEIGHTS_0"] =
        file.add(std::vector<std::uint8_t>(tube.weight.size(), 1), "VEC4", 5121);
    contains(failure_of(file), ".WEIGHTS_0 (accessor 7) contains VEC4 of UNSIGNED_BYTE");
  }
  SECTION("positions, quantised without the word for it") {
    primitive["attributes"]["POSITION"] =
        file.add(std::vector<std::int8_t>(tube.position.size(), 1), "VEC3", 5120);
    contains(failure_of(file), "list KHR_mesh_quantization in extensionsUsed");
  }
  SECTION("inverse bind matrices") {
    file.document["accessors"][4]["componentType"] = 5125;
    contains(failure_of(file), "skin 0 inverse bind matrices (accessor 4) contains MAT4 of UNSIGNED_INT");
  }
  SECTION("animations") {
    file.document["accessors"][5]["componentType"] = 5125;
    contains(failure_of(file), "animation 0 channel 0 input (accessor 5) contains SCALAR of UNSIGNED_INT");
    file.document["accessors"][5]["componentType"] = 5126;
    file.document["accessors"][6]["componentType"] = 5125;
    contains(failure_of(file), "animation 0 channel 0 output (accessor 6) contains VEC4 of UNSIGNED_INT");
  }
  SECTION("sparse indices") {
    file.document["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", file.add_view(std::vector<float>{0})}, {"componentType", 5126}}},
        {"values", {{"bufferView", file.add_view(std::vector<float>{0, 0, 0})}}}};
    contains(failure_of(file), "POSITION: sparse indices have component type 5126");
  }
  SECTION("attributes that are not read") {
    primitive["attributes"]["COLOR_0"] =
        file.add(std::vector<std::uint8_t>(tube.weight.size(), 1), "VEC4", 5121);
    CHECK(warnings_with(file,
                        "attributes have a type that glTF does not allow for them (the first is mesh 0 "
                        "primitive 0.COLOR_0, VEC4 of UNSIGNED_BYTE)") == 1);
  }
}

TEST_CASE("the table of types agrees with the specification") {
  // Each use with all element and component types: the count of those allowed, without and with quantisation.
  const int elements[] = {TINYGLTF_TYPE_SCALAR, TINYGLTF_TYPE_VEC2, TINYGLTF_TYPE_VEC3,
                          TINYGLTF_TYPE_VEC4,   TINYGLTF_TYPE_MAT3, TINYGLTF_TYPE_MAT4};
  struct Row {
    AccessorUse use;
    int plain, quantised;
  };
  const Row rows[] = {{AccessorUse::position, 1, 9},       {AccessorUse::normal, 1, 3},
                      {AccessorUse::tangent, 1, 3},        {AccessorUse::texture_coordinates, 3, 9},
                      {AccessorUse::colour, 6, 6},         {AccessorUse::joints, 2, 2},
                      {AccessorUse::weights, 3, 3},        {AccessorUse::indices, 3, 3},
                      {AccessorUse::morph_position, 1, 5}, {AccessorUse::morph_normal, 1, 3},
                      {AccessorUse::morph_tangent, 1, 3},  {AccessorUse::inverse_bind, 1, 1},
                      {AccessorUse::key_times, 1, 1},      {AccessorUse::translation_or_scale, 1, 1},
                      {AccessorUse::rotation, 5, 5}};
  for (const Row& row : rows)
    for (const bool quantised : {false, true}) {
      tinygltf::Model model;
      if (quantised) model.extensionsUsed = {"KHR_mesh_quantization"};
      int allowed = 0;
      for (const int element : elements)
        for (int component = 5120; component <= 5126; ++component)
          for (const bool normalised : {false, true}) {
            tinygltf::Accessor accessor;
            accessor.type = element;
            accessor.componentType = component;
            // Floats have no normalised form: the word means nothing there.
            accessor.normalized = component != TINYGLTF_COMPONENT_TYPE_FLOAT && normalised;
            if (component == TINYGLTF_COMPONENT_TYPE_FLOAT && normalised) continue;
            allowed += has_allowed_type(model, accessor, row.use);
          }
      CAPTURE(int(row.use), quantised);
      CHECK(allowed == (quantised ? row.quantised : row.plain));
    }
}

TEST_CASE("a vertex without weights follows its own first joint") {
  const ImportedCharacter whole = load(tube_file(long_tube(200)));
  Tube tube = long_tube(200);
  const std::size_t last = tube.position.size() / 3 - 1;
  for (std::size_t k = 0; k < 4; ++k) tube.weight[4 * last + k] = 0;
  const ImportedCharacter read = load(tube_file(tube));
  CHECK(read.mesh.weights == whole.mesh.weights);
  CHECK(has_warning(read.warnings, "1 of 247 skinned vertices have no weights"));
  CHECK(read.warnings.size() == whole.warnings.size() + 1);
  // Two of 247 are the most.
  for (std::size_t k = 0; k < 4; ++k) tube.weight[4 * (last - 1) + k] = 0;
  CHECK(has_warning(load(tube_file(tube)).warnings, "2 of 247"));
  for (std::size_t k = 0; k < 4; ++k) tube.weight[4 * (last - 2) + k] = 0;
  contains(failure_of(tube_file(tube)), "3 of 247 skinned vertices have no weights (need at most 1 %)");
  Tube odd = long_tube(200);
  odd.weight[4 * last] = 0;
  odd.joint[4 * last] = 9;
  contains(failure_of(tube_file(odd)), "has no weights and refers to joint 9, but the skin has only 2");
}

TEST_CASE("a fault that can be read in only one way is read with a warning") {
  GltfBuilder file = tube_file();
  Json& nodes = file.document["nodes"];
  const std::size_t before = load(file).warnings.size();
  SECTION("a matrix beside translation") {
    nodes[3]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    nodes[3]["translation"] = {5, 0, 0};
    CHECK(warnings_with(file, "1 nodes have a matrix as well as a translation, rotation or scale") == 1);
  }
  SECTION("a rotation that is not a unit quaternion") {
    nodes[0]["rotation"] = {0, 0, 0, 2};
    CHECK(warnings_with(file, "1 nodes have a rotation that is not a unit quaternion") == 1);
  }
  SECTION("keys with such rotations") {
    file.add_channel(1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 3});
    CHECK(warnings_with(file, "1 animation channels have rotations that are not unit quaternions") == 1);
  }
  SECTION("several keys at the same time") {
    file.add_channel(1, "translation", {0, 1, 1, 2}, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    CHECK(warnings_with(file, "1 animation channels have several keys at the same time") == 1);
  }
  SECTION("two channels for one thing") {
    file.add_channel(2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 1});
    CHECK(warnings_with(file, "1 animation channels move the same value as another channel") == 1);
  }
  SECTION("a joint twice") {
    file.document["skins"][0]["joints"] = {1, 2, 2};
    std::vector<float> matrices = translation_columns(0, 0, 0);
    for (int i = 0; i < 2; ++i) {
      const std::vector<float> tip = translation_columns(0, -1, 0);
      matrices.insert(matrices.end(), tip.begin(), tip.end());
    }
    file.document["skins"][0]["inverseBindMatrices"] = file.add_floats(matrices, "MAT4");
    CHECK(warnings_with(file, "skin 0 lists joint node 2 twice") == 1);
    CHECK(load(file).mesh.bones.size() == 2);
  }
  SECTION("bounds that do not match") {
    file.document["accessors"][0]["min"] = {-1, 0, -1};
    file.document["accessors"][0]["max"] = {1, 5, 1};
    CHECK(warnings_with(file, "1 accessors of positions have a min and max that do not match") == 1);
  }
  CHECK(load(file).warnings.size() == before + 1);
}

TEST_CASE("bounds that match give no warning") {
  GltfBuilder file = tube_file();
  file.document["accessors"][0]["min"] = {-0.25, 0, -0.25};
  file.document["accessors"][0]["max"] = {0.25, 2, 0.25};
  CHECK(warnings_with(file, "min and max") == 0);
}

TEST_CASE("the index that restarts primitives is a vertex, with a warning") {
  for (const bool is_restart : {false, true}) {
    GltfBuilder file;
    std::vector<float> position(3 * 256, 0.0f);
    position[3] = 1;
    position[3 * 254 + 1] = position[3 * 255 + 1] = 1;
    const int accessor = file.add_floats(position, "VEC3");
    const auto last = std::uint8_t(is_restart ? 255 : 254);
    const int index = file.add(std::vector<std::uint8_t>{0, 1, last}, "SCALAR", 5121);
    file.document["nodes"] = Json::array({{{"mesh", 0}}});
    file.document["meshes"] = Json::array(
        {{{"primitives", Json::array({{{"attributes", {{"POSITION", accessor}}}, {"indices", index}}})}}});
    CHECK(warnings_with(file, "restarts primitives") == (is_restart ? 1 : 0));
    CHECK(load(file).mesh.triangle.size() == 1);
  }
}

TEST_CASE("normals of other lengths are normalised with a warning") {
  GltfBuilder file;
  const int position = file.add_floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  const int normal = file.add_floats({0, 0, 2, 0, 0, 1, 0, 0, 1}, "VEC3");
  const int uv = file.add_floats({0, 0, 1, 0, 0, 1}, "VEC2");
  file.document["nodes"] = Json::array({{{"mesh", 0}}});
  file.document["meshes"] = Json::array(
      {{{"primitives",
         Json::array(
             {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}}}}})}}});
  const ImportedSurface surface = import_surface(file.glb());
  CHECK(has_warning(surface.warnings, "1 vertices have normals that are not of unit length"));
  CHECK(surface.mesh.normal[0].z == 1);
}

TEST_CASE("names of files are decoded as they are written, and links stay inside") {
  const fs::path folder = fs::temp_directory_path() / ("nook_gltf_names_" + std::to_string(getpid()));
  fs::remove_all(folder);
  fs::create_directories(folder / "inner/below");
  const GltfBuilder file = tube_file();
  const std::vector<unsigned char>& data = file.buffer();
  const auto write = [&](const fs::path& name, const void* bytes, std::size_t size) {
    std::ofstream(folder / name, std::ios::binary)
        .write(static_cast<const char*>(bytes), std::streamsize(size));
  };
  const auto import = [&](const std::string& uri, LinkedFiles linked = LinkedFiles::folder) {
    const std::vector<std::byte> text = file.gltf(uri);
    write("inner/tube.gltf", text.data(), text.size());
    return failure_when([&] { import_gltf(folder / "inner/tube.gltf", {linked}); });
  };
  SECTION("percent and plus") {
    for (const auto& [uri, name] :
         {std::pair("100%.bin", "100%.bin"), std::pair("a%zz.bin", "a%zz.bin"), std::pair("%", "%"),
          std::pair("a+b.bin", "a+b.bin"), std::pair("a%2Bb%20c.bin", "a+b c.bin"),
          std::pair("5%25.bin", "5%.bin")}) {
      CAPTURE(uri);
      write(fs::path("inner") / name, data.data(), data.size());
      CHECK(import(uri) == "");
      fs::remove(folder / "inner" / name);
      contains(import(uri), std::string("refers to \"") + name + "\", which does not exist");
    }
  }
  SECTION("links") {
    write("outside.bin", data.data(), data.size());
    write("inner/below/inside.bin", data.data(), data.size());
    fs::create_symlink("../outside.bin", folder / "inner/link.bin");
    fs::create_directory_symlink("..", folder / "inner/up");
    fs::create_symlink("below/inside.bin", folder / "inner/stays.bin");
    fs::create_directory_symlink("inner", folder / "linked");
    for (const char* uri : {"link.bin", "up/outside.bin", "up/inner/up/outside.bin"}) {
      CAPTURE(uri);
      contains(import(uri), "a link that leads outside the folder of this file");
      CHECK(import(uri, LinkedFiles::anywhere) == "");
    }
    const std::string absolute = (folder / "outside.bin").string();
    contains(import(absolute), "outside the folder of this file");
    contains(import("below/../../outside.bin"), "outside the folder of this file");
    CHECK(import("stays.bin") == "");
    CHECK(import("up/inner/below/inside.bin") == "");
    CHECK(failure_when([&] { import_gltf(folder / "linked/tube.gltf"); }) == "");
    contains(import("a%00b.bin"), "NUL");
  }
  fs::remove_all(folder);
}
