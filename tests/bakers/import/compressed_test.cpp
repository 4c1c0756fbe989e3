// Files compressed by meshopt and by Draco against the same files without compression.
#include <meshoptimizer.h>

#include "sdk/src/core/failure.h"
#include "tests/bakers/import/refused_file.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

#if NOOK_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// Writes compressed views beside room for what they hold, as gltfpack does: a second buffer without bytes.
class MeshoptBuilder {
 public:
  explicit MeshoptBuilder(const char* extension) : extension_(extension) {
    file.document["extensionsUsed"] = file.document["extensionsRequired"] = {extension};
  }

  template <typename T>
  int add_attribute(const std::vector<T>& values, const char* type, int component_type, std::size_t count,
                    const char* filter = "NONE", bool normalised = false) {
    const std::size_t stride = values.size() * sizeof(T) / count;
    std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), values.data(), count, stride));
    Json view = extension(bytes, stride, count, "ATTRIBUTES");
    view["filter"] = filter;
    return add(view, type, component_type, count, normalised, true);
  }
  int add_indices(const std::vector<std::uint32_t>& index, const char* mode) {
    std::vector<unsigned char> bytes;
    if (std::string(mode) == "TRIANGLES") {
      bytes.resize(meshopt_encodeIndexBufferBound(index.size(), 1000));
      bytes.resize(meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), index.data(), index.size()));
    } else {
      bytes.resize(meshopt_encodeIndexSequenceBound(index.size(), 1000));
      bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), index.data(), index.size()));
    }
    return add(extension(bytes, 2, index.size(), mode), "SCALAR", 5123, index.size(), false, false);
  }

  // The second buffer is the room.
  GltfBuilder with_room() const {
    GltfBuilder out = file;
    out.add_view(std::vector<float>{});
    out.room = {{"byteLength", room_}, {"extensions", {{extension_, {{"fallback", true}}}}}};
    return out;
  }

  GltfBuilder file;

 private:
  Json extension(const std::vector<unsigned char>& bytes, std::size_t stride, std::size_t count,
                 const char* mode) {
    const int view = file.add_view(bytes);
    const Json at = file.document["bufferViews"][view];
    return {{"buffer", 0},
            {"byteOffset", at["byteOffset"]},
            {"byteLength", bytes.size()},
            {"byteStride", stride},
            {"count", count},
            {"mode", mode}};
  }
  int add(const Json& compressed, const char* type, int component_type, std::size_t count, bool normalised,
          bool has_stride) {
    const std::size_t stride = compressed["byteStride"].get<std::size_t>();
    Json view = {{"buffer", 1},
                 {"byteOffset", room_},
                 {"byteLength", stride * count},
                 {"extensions", {{extension_, compressed}}}};
    if (has_stride) view["byteStride"] = stride;
    room_ = (room_ + stride * count + 3) / 4 * 4;
    file.document["bufferViews"].push_back(view);
    file.document["accessors"].push_back({{"bufferView", file.document["bufferViews"].size() - 1},
                                          {"componentType", component_type},
                                          {"count", count},
                                          {"type", type},
                                          {"normalized", normalised}});
    return int(file.document["accessors"].size()) - 1;
  }

  const char* extension_;
  std::size_t room_ = 0;
};

// The tube with everything compressed; `filtered` clips have the quaternion filter.
MeshoptBuilder compressed_tube(const char* extension, bool filtered = false, const char* mode = "TRIANGLES") {
  const Tube tube;
  const GltfBuilder plain = tube_file(tube);
  MeshoptBuilder made(extension);
  const Json used = made.file.document["extensionsUsed"];
  made.file.document = plain.document;
  for (const char* list : {"accessors", "bufferViews"}) made.file.document[list] = Json::array();
  made.file.document["extensionsUsed"] = made.file.document["extensionsRequired"] = used;
  const std::size_t n = tube.position.size() / 3;
  const int position = made.add_attribute(tube.position, "VEC3", 5126, n);
  const int joint = made.add_attribute(tube.joint, "VEC4", 5121, n);
  const int weight = made.add_attribute(tube.weight, "VEC4", 5126, n);
  const int index = made.add_indices({tube.index.begin(), tube.index.end()}, mode);
  std::vector<float> inverse_bind = translation_columns(0, 0, 0);
  const std::vector<float> tip = translation_columns(0, -1, 0);
  inverse_bind.insert(inverse_bind.end(), tip.begin(), tip.end());
  const int matrices = made.add_attribute(inverse_bind, "MAT4", 5126, 2);
  Json& primitive = made.file.document["meshes"][0]["primitives"][0];
  primitive["attributes"] = {{"POSITION", position}, {"JOINTS_0", joint}, {"WEIGHTS_0", weight}};
  primitive["indices"] = index;
  made.file.document["skins"][0]["inverseBindMatrices"] = matrices;
  const int times = made.add_attribute(std::vector<float>{0, 1}, "SCALAR", 5126, 2);
  const float h = std::sqrt(0.5f);
  const std::vector<float> turns{0, 0, 0, 1, 0, 0, h, h};
  int turn = 0;
  if (filtered) {
    std::vector<std::int16_t> packed(8);
    meshopt_encodeFilterQuat(packed.data(), 2, 8, 16, turns.data());
    turn = made.add_attribute(packed, "VEC4", 5122, 2, "QUATERNION", true);
  } else {
    turn = made.add_attribute(turns, "VEC4", 5126, 2);
  }
  made.file.document["animations"][0]["samplers"] = Json::array({{{"input", times}, {"output", turn}}});
  return made;
}

// The codec of triangles may turn each about its corners.
std::vector<std::array<std::uint32_t, 3>> turned(std::vector<std::array<std::uint32_t, 3>> triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

void check_equal(const ImportedCharacter& a, const ImportedCharacter& b, float tolerance_m) {
  REQUIRE(a.mesh.vertex_count() == b.mesh.vertex_count());
  for (std::size_t v = 0; v < a.mesh.vertex_count(); ++v) {
    CHECK(distance(a.mesh.position[v], b.mesh.position[v]) <= tolerance_m);
    CHECK(a.mesh.weights[v] == b.mesh.weights[v]);
  }
  CHECK(turned(a.mesh.triangle) == turned(b.mesh.triangle));
  REQUIRE(a.clips.size() == b.clips.size());
}

}  // namespace

TEST_CASE("files compressed by meshopt equal the plain ones") {
  const ImportedCharacter plain = load(tube_file());
  for (const char* extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
    for (const char* mode : {"TRIANGLES", "INDICES"}) {
      CAPTURE(extension, mode);
      const ImportedCharacter read = load(compressed_tube(extension, false, mode).with_room());
      check_equal(read, plain, 0);
      CHECK(read.clips[0].channels[0].value == plain.clips[0].channels[0].value);
      CHECK(read.warnings == plain.warnings);
    }
  // Not required, the room in a file of its own that is not there, as text.
  GltfBuilder optional = compressed_tube("EXT_meshopt_compression").with_room();
  optional.document.erase("extensionsRequired");
  optional.room["uri"] = "not there.bin";
  check_equal(load(optional), plain, 0);
  check_equal(import_gltf(optional.gltf()), plain, 0);
  // Rotations of 16 bits.
  const ImportedCharacter filtered = load(compressed_tube("EXT_meshopt_compression", true).with_room());
  check_equal(filtered, plain, 0);
  for (std::size_t i = 0; i < 8; ++i)
    CHECK(std::abs(filtered.clips[0].channels[0].value[i] - plain.clips[0].channels[0].value[i]) < 1e-4f);
}

TEST_CASE("quantised meshes compressed by meshopt equal the plain ones within their steps") {
  const Tube tube;
  MeshoptBuilder made = compressed_tube("EXT_meshopt_compression");
  std::vector<std::int16_t> shorts;
  for (std::size_t v = 0; v < tube.position.size() / 3; ++v)
    for (std::size_t c = 0; c < 4; ++c)
      shorts.push_back(c < 3 ? std::int16_t(std::lround(tube.position[3 * v + c] * 10000)) : std::int16_t(0));
  made.file.document["extensionsUsed"].push_back("KHR_mesh_quantization");
  made.file.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      made.add_attribute(shorts, "VEC3", 5122, shorts.size() / 4);
  made.file.document["skins"][0].erase("inverseBindMatrices");
  made.file.document["nodes"][1]["scale"] = {1e-4, 1e-4, 1e-4};
  made.file.document["nodes"][2]["translation"] = {0, 0, 0};
  const ImportedCharacter read = load(made.with_room());
  const ImportedCharacter plain = load(tube_file());
  REQUIRE(read.mesh.vertex_count() == plain.mesh.vertex_count());
  // Half a step of 1e-4 m on each axis.
  for (std::size_t v = 0; v < read.mesh.vertex_count(); ++v)
    CHECK(distance(read.mesh.position[v], plain.mesh.position[v]) < 0.9e-4f);
}

TEST_CASE("hostile meshopt views are refused by name") {
  MeshoptBuilder made = compressed_tube("EXT_meshopt_compression");
  Json& views = made.file.document["bufferViews"];
  std::size_t v = 0;
  while (!views[v].contains("extensions")) ++v;
  Json& view = views[v]["extensions"]["EXT_meshopt_compression"];
  const auto check = [&](const std::string& part) {
    const std::string message = failure_of(made.with_room());
    INFO(message);
    CHECK(message.find("buffer view " + std::to_string(v) + ", compressed by meshopt") != std::string::npos);
    CHECK(message.find(part) != std::string::npos);
  };
  SECTION("a count beyond the bytes") {
    view["count"] = 100'000'000;
    views[v]["byteLength"] = 1'200'000'000;
    check("cannot come from");
  }
  SECTION("a count that overflows") {
    view["count"] = 0x8000000000000001;
    check("cannot come from");
  }
  SECTION("an offset out of the buffer") {
    view["byteOffset"] = 1 << 30;
    check("starts at byte");
  }
  SECTION("bytes of something else") {
    view["byteOffset"] = view["byteOffset"].get<int>() + 1;
    check("data are damaged");
  }
  SECTION("too few bytes") {
    view["byteLength"] = view["byteLength"].get<int>() - 20;
    check("data are damaged");
  }
  SECTION("strides") {
    view["byteStride"] = 13;
    check("byteStride is 13");
  }
  SECTION("a filter of other strides") {
    view["filter"] = "QUATERNION";
    check("does not fit the filter");
  }
  SECTION("names") {
    view["mode"] = "SOUP";
    check("\"mode\" is \"SOUP\", which Nook does not read");
  }
  SECTION("not a whole number") {
    view["buffer"] = -1;
    check("\"buffer\" is missing or not a whole number");
  }
  SECTION("another buffer") {
    view["buffer"] = 7;
    check("refers to buffer 7");
  }
  SECTION("a length that does not fit") {
    views[v]["byteLength"] = 8;
    check("byteLength is not count times byteStride");
  }
}

#if NOOK_DRACO

namespace {

// The tube compressed; with so many bits for positions, 0: as they are.
GltfBuilder draco_tube(int position_bits) {
  const Tube tube;
  GltfBuilder file = tube_file(tube);
  const std::size_t faces = tube.index.size() / 3;
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(int(faces));
  const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int joint = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8);
  const int weight = builder.AddAttribute(draco::GeometryAttribute::GENERIC, 4, draco::DT_FLOAT32);
  for (std::size_t f = 0; f < faces; ++f) {
    const auto i = [&](std::size_t c) { return std::size_t(tube.index[3 * f + c]); };
    const auto set = [&](int attribute, const auto& values, std::size_t n) {
      builder.SetAttributeValuesForFace(attribute, draco::FaceIndex(std::uint32_t(f)), &values[n * i(0)],
                                        &values[n * i(1)], &values[n * i(2)]);
    };
    set(position, tube.position, 3);
    set(joint, tube.joint, 4);
    set(weight, tube.weight, 4);
  }
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
  if (position_bits > 0) encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, position_bits);
  draco::EncoderBuffer bytes;
  REQUIRE(encoder.EncodeMeshToBuffer(*mesh, &bytes).ok());
  const int view = file.add_view(std::vector<char>(bytes.data(), bytes.data() + bytes.size()));
  for (const int accessor : {0, 1, 2, 3}) file.document["accessors"][accessor].erase("bufferView");
  for (const int accessor : {0, 1, 2}) file.document["accessors"][accessor]["count"] = mesh->num_points();
  file.document["extensionsUsed"] = file.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  file.document["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", view},
      {"attributes",
       {{"POSITION", mesh->attribute(position)->unique_id()},
        {"JOINTS_0", mesh->attribute(joint)->unique_id()},
        {"WEIGHTS_0", mesh->attribute(weight)->unique_id()}}}};
  return file;
}

// Draco orders vertices and triangles as it likes: for each vertex of one the nearest of the other.
void check_same_shape(const ImportedCharacter& a, const ImportedCharacter& b, float tolerance_m) {
  REQUIRE(a.mesh.vertex_count() == b.mesh.vertex_count());
  REQUIRE(a.mesh.triangle.size() == b.mesh.triangle.size());
  for (std::size_t v = 0; v < a.mesh.vertex_count(); ++v) {
    std::size_t nearest = 0;
    for (std::size_t w = 0; w < b.mesh.vertex_count(); ++w)
      if (distance(a.mesh.position[v], b.mesh.position[w]) <
          distance(a.mesh.position[v], b.mesh.position[nearest]))
        nearest = w;
    CHECK(distance(a.mesh.position[v], b.mesh.position[nearest]) <= tolerance_m);
    CHECK(a.mesh.weights[v] == b.mesh.weights[nearest]);
  }
  CHECK(std::abs(signed_volume(a.mesh) - signed_volume(b.mesh)) <= 20 * tolerance_m);
}

}  // namespace

TEST_CASE("files compressed by Draco equal the plain ones") {
  const ImportedCharacter plain = load(tube_file());
  check_same_shape(load(draco_tube(0)), plain, 1e-6f);
  // Steps of 2 m / 2^14, half of one on each axis.
  check_same_shape(load(draco_tube(14)), plain, 1.1e-4f);
  // Without the word that it is required, there is no other data either.
  GltfBuilder optional = draco_tube(0);
  optional.document.erase("extensionsRequired");
  check_same_shape(load(optional), plain, 1e-6f);
}

TEST_CASE("hostile Draco data is refused by name") {
  GltfBuilder file = draco_tube(0);
  Json& primitive = file.document["meshes"][0]["primitives"][0];
  Json& extension = primitive["extensions"]["KHR_draco_mesh_compression"];
  const std::size_t view = extension["bufferView"].get<std::size_t>();
  const auto check = [&](const std::string& part) {
    const std::string message = failure_of(file);
    INFO(message);
    CHECK(message.find("mesh 0 primitive 0") != std::string::npos);
    CHECK(message.find(part) != std::string::npos);
  };
  SECTION("other bytes") {
    extension["bufferView"] = 0;
    check("data are damaged");
  }
  SECTION("too few bytes") {
    file.document["bufferViews"][view]["byteLength"] = 60;
    check("data are damaged");
  }
  SECTION("no view") {
    extension["bufferView"] = 99;
    check("refers to buffer view 99");
  }
  SECTION("an attribute that is not there") {
    extension["attributes"]["POSITION"] = 77;
    check("refers to identifier 77");
  }
  SECTION("an attribute of other components") {
    extension["attributes"]["POSITION"] = extension["attributes"]["JOINTS_0"];
    check("its accessor has a different number");
  }
  SECTION("no number") {
    extension["bufferView"] = "x";
    check("\"bufferView\" is missing or not a whole number");
  }
}

#endif
