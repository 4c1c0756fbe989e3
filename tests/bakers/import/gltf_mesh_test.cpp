// Meshes of synthetic files: welding, placement, and the many ways to write the same triangles.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "bakers/import/skinned_mesh.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// Positions are sums and products of a few floats of size 2: a few units in the last place.
constexpr float tolerance_m = 1e-6f;

// Area of a right prism with 8 sides, caps included; what every way of writing the tube must give.
float tube_area() {
  const float side = 2 * Tube::radius * std::sin(static_cast<float>(M_PI) / Tube::sides);
  const float apothem = Tube::radius * std::cos(static_cast<float>(M_PI) / Tube::sides);
  return Tube::sides * side * 2 + 2 * Tube::sides * side * apothem / 2;
}

float area(const SkinnedMesh& mesh) {
  float sum = 0;
  for (const float a : vertex_areas(mesh, mesh.position)) sum += a;
  return sum;
}

}  // namespace

TEST_CASE("a tube is welded across its seam and keeps its file order") {
  const ImportedCharacter tube = load(tube_file());
  CHECK(tube.mesh.vertex_count() == Tube::welded_vertices);
  CHECK(tube.mesh.triangle.size() == Tube::triangles);
  REQUIRE(tube.mesh.file_to_welded.size() == Tube::file_vertices);
  REQUIRE(tube.mesh.primitives.size() == 1);
  CHECK(tube.mesh.primitives[0].mesh_name == "tube");
  CHECK(tube.mesh.primitives[0].vertex_count == Tube::file_vertices);
  CHECK(tube.warnings.empty());
  const Tube source;
  for (int v = 0; v < Tube::file_vertices; ++v) {
    const Vec3 p{source.position[3 * v], source.position[3 * v + 1], source.position[3 * v + 2]};
    CHECK(distance(tube.mesh.position[tube.mesh.file_to_welded[v]], p) <= tolerance_m);
  }
  CHECK(tube.mesh.file_to_welded[0] == tube.mesh.file_to_welded[Tube::sides]);
  CHECK(signed_volume(tube.mesh) > 0);
  CHECK(std::abs(area(tube.mesh) - tube_area()) < 1e-5f);
}

TEST_CASE("a skin below a 0.01 scale and a 90 degree turn lands in metres, upright") {
  GltfBuilder file = tube_file();
  // The tube again in centimetres with z up, as many exporters leave it: file (x, y, z) stands for world (x,
  // z, -y) / 100.
  Tube tube;
  for (std::size_t v = 0; v < tube.position.size(); v += 3) {
    const float y = tube.position[v + 1];
    tube.position[v] *= 100;
    tube.position[v + 1] = -100 * tube.position[v + 2];
    tube.position[v + 2] = 100 * y;
  }
  file = tube_file(tube);
  const float h = std::sqrt(0.5f);
  file.document["nodes"][0]["scale"] = {0.01, 0.01, 0.01};
  file.document["nodes"][0]["rotation"] = {-h, 0, 0, h};
  file.document["nodes"][2]["translation"] = {0, 0, 100};
  std::vector<float> inverse_bind = translation_columns(0, 0, 0);
  const std::vector<float> tip = translation_columns(0, 0, -100);
  inverse_bind.insert(inverse_bind.end(), tip.begin(), tip.end());
  file.document["skins"][0]["inverseBindMatrices"] = file.add_floats(inverse_bind, "MAT4");

  const ImportedCharacter scaled = load(file);
  const ImportedCharacter plain = load(tube_file());
  REQUIRE(scaled.mesh.file_to_welded.size() == plain.mesh.file_to_welded.size());
  for (std::size_t v = 0; v < plain.mesh.file_to_welded.size(); ++v)
    CHECK(distance(scaled.mesh.position[scaled.mesh.file_to_welded[v]],
                   plain.mesh.position[plain.mesh.file_to_welded[v]]) < 1e-5f);
  CHECK(distance(transform_point(scaled.mesh.bones[1].frame_rest, {}), {0, 1, 0}) < 1e-5f);
  CHECK(signed_volume(scaled.mesh) > 0);
  // The clip turns the tip about the file's z axis, which is the world's y axis: no vertex changes its
  // height.
  std::vector<Vec3> posed;
  skin_positions(scaled.mesh, sample_clip(scaled, 0, 1), posed);
  for (std::size_t v = 0; v < posed.size(); ++v)
    CHECK(std::abs(posed[v].y - scaled.mesh.position[v].y) < 1e-5f);
}

TEST_CASE("text with a data URI, text with a buffer file and binary give the same mesh") {
  const GltfBuilder file = tube_file();
  const ImportedCharacter binary = load(file);
  const ImportedCharacter text = import_gltf(file.gltf());
  const auto folder = std::filesystem::temp_directory_path() / "nook_import_test";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, const auto& bytes) {
    std::ofstream(folder / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  };
  write("tube.bin", file.buffer());
  write("tube.gltf", file.gltf("tube.bin"));
  const ImportedCharacter split = import_gltf(folder / "tube.gltf");
  for (const ImportedCharacter* other : {&text, &split}) {
    CHECK(other->mesh.position == binary.mesh.position);
    CHECK(other->mesh.triangle == binary.mesh.triangle);
    CHECK(other->mesh.weights == binary.mesh.weights);
    CHECK(other->source_hash == binary.source_hash);
  }
  // The hash covers the buffer's file as well.
  std::vector<unsigned char> changed = file.buffer();
  changed[0] ^= 1;
  write("tube.bin", changed);
  CHECK(import_gltf(folder / "tube.gltf").source_hash != split.source_hash);
  std::filesystem::remove_all(folder);
}

TEST_CASE("lists without indices, strips and fans make the same surface") {
  const Tube source;
  SECTION("no indices") {
    Tube tube;
    tube.position.clear();
    tube.joint.clear();
    tube.weight.clear();
    for (const int i : source.index) {
      tube.position.insert(tube.position.end(), &source.position[3 * i], &source.position[3 * i] + 3);
      tube.joint.insert(tube.joint.end(), &source.joint[4 * i], &source.joint[4 * i] + 4);
      tube.weight.insert(tube.weight.end(), &source.weight[4 * i], &source.weight[4 * i] + 4);
    }
    GltfBuilder file = tube_file(tube);
    file.document["meshes"][0]["primitives"][0].erase("indices");
    const ImportedCharacter character = load(file);
    CHECK(character.mesh.vertex_count() == Tube::welded_vertices);
    CHECK(character.mesh.file_to_welded.size() == 3u * Tube::triangles);
    CHECK(std::abs(signed_volume(character.mesh) - signed_volume(load(tube_file()).mesh)) < 1e-6f);
  }
  SECTION("strips for the side, fans for the caps") {
    GltfBuilder file = tube_file();
    const Json base = file.document["meshes"][0]["primitives"][0];
    Json primitives = Json::array();
    const auto add = [&](const std::vector<std::uint16_t>& index, int mode) {
      Json primitive = base;
      primitive["indices"] = file.add(index, "SCALAR", 5123);
      primitive["mode"] = mode;
      primitives.push_back(primitive);
    };
    for (int r = 0; r + 1 < Tube::rings; ++r) {
      std::vector<std::uint16_t> strip;
      for (int c = 0; c < Tube::columns; ++c) {
        strip.push_back(static_cast<std::uint16_t>(r * Tube::columns + c));
        strip.push_back(static_cast<std::uint16_t>((r + 1) * Tube::columns + c));
      }
      add(strip, 5);
    }
    std::vector<std::uint16_t> bottom = {Tube::columns * Tube::rings};
    std::vector<std::uint16_t> top = {Tube::columns * Tube::rings + 1};
    for (int c = 0; c < Tube::columns; ++c) {
      bottom.push_back(static_cast<std::uint16_t>(c));
      top.push_back(static_cast<std::uint16_t>((Tube::rings - 1) * Tube::columns + Tube::columns - 1 - c));
    }
    add(bottom, 6);
    add(top, 6);
    file.document["meshes"][0]["primitives"] = primitives;
    const ImportedCharacter character = load(file);
    CHECK(character.mesh.triangle.size() == Tube::triangles);
    CHECK(character.mesh.vertex_count() == Tube::welded_vertices);
    CHECK(character.mesh.primitives.size() == static_cast<std::size_t>(Tube::rings - 1 + 2));
    CHECK(std::abs(signed_volume(character.mesh) - signed_volume(load(tube_file()).mesh)) < 1e-6f);
    CHECK(std::abs(area(character.mesh) - tube_area()) < 1e-5f);
  }
  SECTION("lines are left out with a warning") {
    GltfBuilder file = tube_file();
    Json lines = file.document["meshes"][0]["primitives"][0];
    lines["mode"] = 1;
    file.document["meshes"][0]["primitives"].push_back(lines);
    const ImportedCharacter character = load(file);
    CHECK(character.mesh.primitives.size() == 1);
    CHECK(has_warning(character.warnings, "points or lines"));
  }
}

TEST_CASE("weights come in every format and need not add up to one") {
  const Tube source;
  const ImportedCharacter plain = load(tube_file());
  SECTION("sums of 2.5") {
    Tube tube;
    for (float& w : tube.weight) w *= 2.5f;
    const ImportedCharacter character = load(tube_file(tube));
    CHECK(character.mesh.weights == plain.mesh.weights);
    CHECK(has_warning(character.warnings, "do not add up to 1 (worst sum 2.5)"));
  }
  SECTION("normalised bytes") {
    GltfBuilder file = tube_file();
    std::vector<std::uint8_t> bytes;
    // 127 and 127 instead of 127.5: the sum is not 255, the halves are still equal.
    for (const float w : source.weight) bytes.push_back(static_cast<std::uint8_t>(w * 255));
    file.document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] =
        file.add(bytes, "VEC4", 5121, true);
    CHECK(load(file).mesh.weights == plain.mesh.weights);
  }
  SECTION("normalised shorts and joints of 16 bits") {
    GltfBuilder file = tube_file();
    std::vector<std::uint16_t> shorts;
    for (const float w : source.weight) shorts.push_back(static_cast<std::uint16_t>(w * 65535));
    const std::vector<std::uint16_t> joints(source.joint.begin(), source.joint.end());
    Json& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = file.add(shorts, "VEC4", 5123, true);
    attributes["JOINTS_0"] = file.add(joints, "VEC4", 5123);
    CHECK(load(file).mesh.weights == plain.mesh.weights);
  }
  SECTION("a second set is added to the first, entries of one bone become one") {
    GltfBuilder file = tube_file();
    std::vector<float> halves = source.weight;
    for (float& w : halves) w /= 2;
    Json& attributes = file.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["WEIGHTS_0"] = file.add_floats(halves, "VEC4");
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    CHECK(load(file).mesh.weights == plain.mesh.weights);
  }
  SECTION("negative weights count as none") {
    Tube tube;
    tube.weight[2] = -0.5f;
    const ImportedCharacter character = load(tube_file(tube));
    CHECK(character.mesh.weights == plain.mesh.weights);
    CHECK(has_warning(character.warnings, "1 negative weights"));
  }
}

TEST_CASE("a sparse accessor overrides its dense values") {
  GltfBuilder file = tube_file();
  const int top = Tube::file_vertices - 1;
  Json& accessor = file.document["accessors"][0];
  accessor["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", file.add_view(std::vector<std::uint16_t>{top})}, {"componentType", 5123}}},
      {"values", {{"bufferView", file.add_view(std::vector<float>{0, 3, 0})}}}};
  const ImportedCharacter character = load(file);
  CHECK(distance(character.mesh.position[character.mesh.file_to_welded[top]], {0, 3, 0}) <= tolerance_m);
  CHECK(distance(character.mesh.position[character.mesh.file_to_welded[top - 1]], {0, 0, 0}) <= tolerance_m);
}

TEST_CASE("interleaved vertex data are read by their stride") {
  GltfBuilder file = tube_file();
  const Tube source;
  std::vector<float> interleaved;
  for (int v = 0; v < Tube::file_vertices; ++v)
    interleaved.insert(interleaved.end(), {9, source.position[3 * v], source.position[3 * v + 1],
                                           source.position[3 * v + 2], 9});
  const int view = file.add_view(interleaved);
  file.document["bufferViews"][view]["byteStride"] = 20;
  file.document["accessors"][0]["bufferView"] = view;
  file.document["accessors"][0]["byteOffset"] = 4;
  CHECK(load(file).mesh.position == load(tube_file()).mesh.position);
}

TEST_CASE("triangles without area are dropped and counted") {
  Tube tube;
  tube.index.insert(tube.index.end(),
                    {0, 0, 1, 0, 9, 18});  // a corner twice; three rings of one column on a line
  const ImportedCharacter character = load(tube_file(tube));
  CHECK(character.mesh.triangle.size() == Tube::triangles);
  CHECK(has_warning(character.warnings,
                    "2 of " + std::to_string(Tube::triangles + 2) + " triangles have no area"));
}

TEST_CASE("a body of implausible size gives a warning") {
  GltfBuilder file = tube_file();
  file.document["nodes"][0]["scale"] = {100, 100, 100};
  CHECK(has_warning(load(file).warnings, "may not be metres"));
}
