#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "tests/bakers/api/handles.h"
#include "tests/catch.h"

namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

nook_result read(nook_bake_character character, nook_bake_array array, void* out, std::uint32_t count) {
  return nook_bake_character_read(character, array, out, count, 0);
}

struct TubeDesc {
  tube t;
  nook_bake_source_desc desc;
  TubeDesc() {
    make_tube(&t);
    desc = describe_tube(&t);
  }
  // The result of creating a character from it; nothing must be handed out on failure.
  nook_result create() {
    nook_bake_character character = nullptr;
    const nook_result result = nook_bake_character_create(&desc, &character);
    CHECK((character != nullptr) == (result == NOOK_OK));
    nook_bake_character_destroy(&character);
    return result;
  }
};

}  // namespace

TEST_CASE("a character that was imported from memory equals the given arrays") {
  const Character character = tube_character();
  REQUIRE(character);
  nook_bake_character_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_bake_character_describe(character.get(), &info) == NOOK_OK);
  CHECK(info.vertex_count == tube_vertices);
  CHECK(info.file_vertex_count == tube_vertices);
  CHECK(info.triangle_count == tube_triangles);
  CHECK(info.bone_count == 2);
  CHECK(info.clip_count == 0);
  CHECK(info.primitive_count == 1);
  CHECK(info.bounds_min[0] == 0);
  CHECK(info.bounds_max[0] == 1);

  tube t;
  make_tube(&t);
  std::vector<float> positions(3 * tube_vertices), normals(3 * tube_vertices);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_POSITIONS, positions.data(), tube_vertices) == NOOK_OK);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_NORMALS, normals.data(), tube_vertices) == NOOK_OK);
  CHECK(std::memcmp(positions.data(), t.positions, sizeof t.positions) == 0);
  // The normals of a tube point away from its axis; ten flat sides and area weights keep this exact up to
  // rounding, but for the rings at its ends, whose triangles are not symmetric.
  for (int v = tube_segments; v < tube_vertices - tube_segments; ++v) {
    const float* p = &positions[3 * std::size_t(v)];
    const float* n = &normals[3 * std::size_t(v)];
    CHECK(std::fabs((p[1] * n[1] + p[2] * n[2]) / 0.1f) > 0.99f);
  }
  std::vector<std::uint32_t> indices(3 * tube_triangles);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_TRIANGLES, indices.data(), tube_triangles) == NOOK_OK);
  CHECK(std::memcmp(indices.data(), t.indices, sizeof t.indices) == 0);

  std::vector<std::uint16_t> joints(4 * tube_vertices);
  std::vector<float> weights(4 * tube_vertices);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_JOINTS, joints.data(), tube_vertices) == NOOK_OK);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_WEIGHTS, weights.data(), tube_vertices) == NOOK_OK);
  for (std::size_t v = 0; v < tube_vertices; ++v) {
    float tip = 0, sum = 0;
    for (std::size_t s = 4 * v; s < 4 * v + 4; ++s) {
      sum += weights[s];
      if (joints[s] == 1) tip += weights[s];
    }
    CHECK(std::fabs(sum - 1) < 1e-6f);
    CHECK(std::fabs(tip - t.weights[2 * v + 1]) < 1e-6f);
  }
  std::int32_t parents[2] = {};
  float frames[24] = {};
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_PARENTS, parents, 2) == NOOK_OK);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_FRAMES, frames, 2) == NOOK_OK);
  CHECK(std::memcmp(parents, t.parents, sizeof parents) == 0);
  CHECK(std::memcmp(frames, t.frames, sizeof frames) == 0);
}

TEST_CASE("arrays are read into a caller's own structs, whose other bytes stay") {
  const Character character = tube_character();
  struct Vertex {
    float position[3];
    float own = 7;
  };
  std::vector<Vertex> vertices(tube_vertices);
  REQUIRE(nook_bake_character_read(character.get(), NOOK_BAKE_ARRAY_POSITIONS, vertices.data(), tube_vertices,
                                   sizeof(Vertex)) == NOOK_OK);
  tube t;
  make_tube(&t);
  for (std::size_t v = 0; v < tube_vertices; ++v) {
    CHECK(std::memcmp(vertices[v].position, t.positions + 3 * v, sizeof vertices[v].position) == 0);
    CHECK(vertices[v].own == 7);
  }
  CHECK(nook_bake_character_read(character.get(), NOOK_BAKE_ARRAY_POSITIONS, vertices.data(), tube_vertices,
                                 11) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("stride is too small (got 11 bytes, need 0 or at least 12)"));
}

TEST_CASE("names are valid while their character lives") {
  const Character character = tube_character();
  REQUIRE(character);
  const char* const bone = nook_bake_character_name(character.get(), NOOK_BAKE_NAME_BONE, 1);
  const char* const primitive = nook_bake_character_name(character.get(), NOOK_BAKE_NAME_PRIMITIVE, 0);
  const std::string bone_text = bone, primitive_text = primitive;
  for (int i = 0; i < 20; ++i) REQUIRE(tube_character());
  CHECK(nook_bake_character_name(character.get(), NOOK_BAKE_NAME_BONE, 1) == bone);
  CHECK(nook_bake_character_name(character.get(), NOOK_BAKE_NAME_PRIMITIVE, 0) == primitive);
  CHECK(bone_text == bone);
  CHECK(primitive_text == primitive);
}

TEST_CASE("split vertices come back in file order and agree") {
  TubeDesc d;
  // Two primitives that both hold the last ring's vertices would need a copy of it; here the whole tube comes
  // twice.
  std::vector<float> positions(d.t.positions, d.t.positions + 3 * tube_vertices);
  positions.insert(positions.end(), d.t.positions, d.t.positions + 3 * tube_vertices);
  std::vector<std::uint16_t> joints(d.t.joints, d.t.joints + 2 * tube_vertices);
  joints.insert(joints.end(), d.t.joints, d.t.joints + 2 * tube_vertices);
  std::vector<float> weights(d.t.weights, d.t.weights + 2 * tube_vertices);
  weights.insert(weights.end(), d.t.weights, d.t.weights + 2 * tube_vertices);
  const nook_range primitives[] = {{0, tube_vertices}, {tube_vertices, tube_vertices}};
  d.desc.positions = positions.data();
  d.desc.joints = joints.data();
  d.desc.weights = weights.data();
  d.desc.vertex_count = 2 * tube_vertices;
  d.desc.primitives = primitives;
  d.desc.primitive_count = 2;
  nook_bake_character handle = nullptr;
  REQUIRE(nook_bake_character_create(&d.desc, &handle) == NOOK_OK);
  const Character character(handle);
  nook_bake_character_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_bake_character_describe(handle, &info) == NOOK_OK);
  CHECK(info.vertex_count == tube_vertices);
  CHECK(info.file_vertex_count == 2 * tube_vertices);
  nook_range ranges[2] = {};
  REQUIRE(read(handle, NOOK_BAKE_ARRAY_PRIMITIVES, ranges, 2) == NOOK_OK);
  CHECK(ranges[0].first == 0);
  CHECK(ranges[1].first == tube_vertices);
  CHECK(ranges[1].count == tube_vertices);
  std::vector<float> out(6 * tube_vertices), normals(6 * tube_vertices);
  REQUIRE(read(handle, NOOK_BAKE_ARRAY_POSITIONS, out.data(), 2 * tube_vertices) == NOOK_OK);
  REQUIRE(read(handle, NOOK_BAKE_ARRAY_NORMALS, normals.data(), 2 * tube_vertices) == NOOK_OK);
  CHECK(out == positions);
  CHECK(std::memcmp(normals.data(), normals.data() + 3 * tube_vertices, 3 * tube_vertices * sizeof(float)) ==
        0);
}

TEST_CASE("skinning moves the vertices by their bones") {
  const Character character = tube_character();
  // The tip is lifted by a metre, the root stays.
  float bones[24] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0};
  std::vector<float> rest(3 * tube_vertices), posed(3 * tube_vertices);
  REQUIRE(read(character.get(), NOOK_BAKE_ARRAY_POSITIONS, rest.data(), tube_vertices) == NOOK_OK);
  REQUIRE(nook_bake_character_skin(character.get(), bones, 2, posed.data(), nullptr, tube_vertices) ==
          NOOK_OK);
  tube t;
  make_tube(&t);
  for (std::size_t v = 0; v < tube_vertices; ++v) {
    CHECK(std::fabs(posed[3 * v] - rest[3 * v]) < 1e-6f);
    CHECK(std::fabs(posed[3 * v + 1] - rest[3 * v + 1] - t.weights[2 * v + 1]) < 1e-6f);
  }
  bones[5] = nan_value;
  CHECK(nook_bake_character_skin(character.get(), bones, 2, posed.data(), nullptr, tube_vertices) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("bone 0"));
  CHECK(nook_bake_character_skin(character.get(), bones, 3, posed.data(), nullptr, tube_vertices) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("bone_count is wrong (got 3, need 2)"));
}

TEST_CASE("generated poses are rigid and the same for the same seed") {
  const Character character = tube_character();
  std::vector<float> a(24 * 5), b(24 * 5), c(24 * 5);
  REQUIRE(nook_bake_character_auto_poses(character.get(), 7, 5, a.data(), 2) == NOOK_OK);
  REQUIRE(nook_bake_character_auto_poses(character.get(), 7, 5, b.data(), 2) == NOOK_OK);
  REQUIRE(nook_bake_character_auto_poses(character.get(), 8, 5, c.data(), 2) == NOOK_OK);
  CHECK(a == b);
  CHECK(a != c);
  for (std::size_t m = 0; m < 10; ++m)
    for (std::size_t column = 0; column < 3; ++column) {
      float square = 0;
      for (std::size_t row = 0; row < 3; ++row)
        square += a[12 * m + 4 * row + column] * a[12 * m + 4 * row + column];
      CHECK(std::fabs(square - 1) < 1e-4f);  // products of a few single-precision rotations
    }
  std::uint32_t count = 0;
  REQUIRE(nook_bake_character_single_joint_poses(character.get(), 3, 45, &count, nullptr, 2) == NOOK_OK);
  CHECK(count == 27);  // one joint moves some but not all vertices; the rest pose is the middle of its grid
  std::vector<float> grid(24 * 27);
  count = 26;
  CHECK(nook_bake_character_single_joint_poses(character.get(), 3, 45, &count, grid.data(), 2) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  count = 27;
  CHECK(nook_bake_character_single_joint_poses(character.get(), 3, 45, &count, grid.data(), 2) == NOOK_OK);
  CHECK(nook_bake_character_single_joint_poses(character.get(), 0, 45, &count, nullptr, 2) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_character_single_joint_poses(character.get(), 3, nan_value, &count, nullptr, 2) ==
        NOOK_ERROR_INVALID_ARGUMENT);
}

TEST_CASE("a file names others outside of its folder only where that is allowed") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("nook_outside_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder / "inner");
  const float position[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::ofstream(folder / "outside.bin", std::ios::binary)
      .write(reinterpret_cast<const char*>(position), sizeof position);
  std::ofstream(folder / "inner/file.gltf")
      << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":"../outside.bin"}],)"
      << R"("bufferViews":[{"buffer":0,"byteLength":36}],"nodes":[{"mesh":0}],)"
      << R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
      << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]})";
  const std::string path = (folder / "inner/file.gltf").string();
  nook_bake_source_desc desc;
  REQUIRE(nook_bake_source_desc_init(&desc) == NOOK_OK);
  desc.path = path.c_str();
  nook_bake_character character = nullptr;
  CHECK(nook_bake_character_create(&desc, &character) == NOOK_ERROR_BAD_FILE);
  CHECK(message_has("outside the folder of this file"));
  desc.allow_outside_files = 2;
  CHECK(nook_bake_character_create(&desc, &character) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.allow_outside_files"));
  desc.allow_outside_files = 1;
  CHECK(nook_bake_character_create(&desc, &character) == NOOK_OK);
  nook_bake_character_destroy(&character);
  std::filesystem::remove_all(folder);
}

TEST_CASE("a pipe is refused, because nobody may ever write into it") {
  const std::filesystem::path pipe =
      std::filesystem::temp_directory_path() / ("nook_pipe_" + std::to_string(getpid()));
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  nook_bake_source_desc desc;
  REQUIRE(nook_bake_source_desc_init(&desc) == NOOK_OK);
  nook_bake_character character = nullptr;
  const std::string link = pipe.string() + "_link";
  std::filesystem::create_symlink(pipe, link);
  for (const std::string& path : {pipe.string(), link, std::string("/dev/zero")}) {
    CAPTURE(path);
    desc.path = path.c_str();
    CHECK(nook_bake_character_create(&desc, &character) == NOOK_ERROR_BAD_FILE);
    CHECK(message_has("not a regular file"));
    CHECK(message_has(path.c_str()));
  }
  std::filesystem::remove(pipe);
  std::filesystem::remove(link);
}

TEST_CASE("faults of a mesh in memory are named") {
  TubeDesc d;
  SECTION("a NULL array") {
    d.desc.positions = nullptr;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.positions is NULL"));
  }
  SECTION("a file as well") {
    d.desc.path = "tube.glb";
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc contains more than one of desc.path, desc.bytes and arrays"));
  }
  SECTION("nothing") {
    REQUIRE(nook_bake_source_desc_init(&d.desc) == NOOK_OK);
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc contains none of desc.path, desc.bytes and arrays"));
  }
  SECTION("a position that is not finite") {
    d.t.positions[40] = nan_value;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("a position that no model can hold") {
    d.t.positions[40] = -1.1e6f;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("position that is not finite or beyond 1e6 m: 1 of 180, the first has index 13"));
  }
  SECTION("a joint that no model can hold") {
    d.t.frames[12 + 7] = 1e18f;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("the joint of bone 1"));
    CHECK(message_has("is out of range (got 0.5 1e+18 0"));
  }
  SECTION("an index out of range") {
    d.t.indices[5] = tube_vertices;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("a joint out of range") {
    d.t.joints[2 * (tube_vertices - 1) + 1] = 2;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("weights that are all zero") {
    d.t.weights[0] = d.t.weights[1] = 0;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("a parent after its child") {
    d.t.parents[0] = 1;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("no triangles") {
    d.desc.index_count = 0;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("no bones") {
    d.desc.bone_count = 0;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
  }
  SECTION("no influences") {
    d.desc.influences = 0;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.influences is out of range (got 0"));
  }
  SECTION("an extension") {
    d.desc.next = &d;
    CHECK(d.create() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(message_has("desc.next is not NULL"));
  }
  CHECK(message_has("nook_bake_character_create: "));
}

TEST_CASE("NULL handles and wrong counts are refused") {
  const Character character = tube_character();
  const nook_bake_character c = character.get();
  float f[24] = {};
  nook_bake_character_info info{};
  CHECK(nook_bake_character_describe(c, &info) == NOOK_ERROR_INVALID_ARGUMENT);  // struct_size is 0
  CHECK(nook_bake_character_describe(nullptr, &info) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_character_describe(c, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_character_name(nullptr, NOOK_BAKE_NAME_BONE, 0) == nullptr);
  CHECK(nook_bake_character_name(c, NOOK_BAKE_NAME_BONE, 2) == nullptr);
  CHECK(nook_bake_character_name(c, NOOK_BAKE_NAME_CLIP, 0) == nullptr);
  CHECK(nook_bake_character_name(c, NOOK_BAKE_NAME_PRIMITIVE, 1) == nullptr);
  CHECK(nook_bake_character_name(c, NOOK_BAKE_NAME_WARNING, ~0u) == nullptr);
  CHECK(nook_bake_character_name(c, 4, 0) == nullptr);
  CHECK(read(nullptr, NOOK_BAKE_ARRAY_FRAMES, f, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(read(c, NOOK_BAKE_ARRAY_FRAMES, f, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("count is wrong (got 1, need 2)"));
  for (nook_bake_array array = NOOK_BAKE_ARRAY_PARENTS; array <= NOOK_BAKE_ARRAY_WEIGHTS; ++array) {
    CHECK(read(c, array, f, 0) == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(read(c, array, nullptr, tube_vertices) == NOOK_ERROR_INVALID_ARGUMENT);
  }
  CHECK(read(c, 8, f, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("array is unknown (got 8)"));
  CHECK(nook_bake_character_auto_poses(c, 1, 1, nullptr, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_character_clip_duration(c, 0, f) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_bake_character_sample_clip(c, 0, 0, f, 2) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_bake_source_desc source;
  REQUIRE(nook_bake_source_desc_init(&source) == NOOK_OK);
  nook_bake_character none = nullptr;
  source.bytes = "x";
  source.byte_count = 1;
  CHECK(nook_bake_character_create(&source, &none) == NOOK_ERROR_BAD_FILE);
  CHECK(nook_bake_character_create(&source, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
  nook_bake_character_destroy(nullptr);
}

TEST_CASE("the meshes of a file are chosen by name") {
  // A triangle that two nodes show.
  const std::string file =
      R"({"asset": {"version": "2.0"}, "nodes": [{"name": "Body", "mesh": 0}, {"name": "Sword", "mesh": 0}],
          "meshes": [{"name": "blade", "primitives": [{"attributes": {"POSITION": 0}}]}],
          "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
          "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
          "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  nook_bake_source_desc desc;
  REQUIRE(nook_bake_source_desc_init(&desc) == NOOK_OK);
  desc.bytes = file.data();
  desc.byte_count = file.size();
  const auto triangles = [&](nook_result expected) {
    nook_bake_character c = nullptr;
    CHECK(nook_bake_character_create(&desc, &c) == expected);
    nook_bake_character_info info{};
    info.struct_size = sizeof info;
    if (c) nook_bake_character_describe(c, &info);
    nook_bake_character_destroy(&c);
    return info.triangle_count;
  };
  CHECK(triangles(NOOK_OK) == 2);
  const char* const names[] = {"S?ord", "Axe"};
  desc.without = names;
  desc.without_count = 1;
  CHECK(triangles(NOOK_OK) == 1);
  desc.without_count = 2;
  triangles(NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("is named \"Axe\""));
  CHECK(message_has("the file has \"Body\", \"Sword\", \"blade\""));
  desc.without_count = 0;
  desc.meshes = names;
  desc.mesh_count = 1;
  CHECK(triangles(NOOK_OK) == 1);
  desc.meshes = nullptr;
  triangles(NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.meshes is NULL"));

  TubeDesc arrays;
  arrays.desc.meshes = names;
  arrays.desc.mesh_count = 1;
  CHECK(arrays.create() == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(message_has("desc.meshes and desc.without choose meshes of a file"));
}

TEST_CASE("reading a character refuses strides that overflow") {
  const Character character = tube_character();
  REQUIRE(character);
  struct Array {
    nook_bake_array array;
    std::uint32_t count;
  };
  const Array arrays[] = {{NOOK_BAKE_ARRAY_PARENTS, 2},
                          {NOOK_BAKE_ARRAY_FRAMES, 2},
                          {NOOK_BAKE_ARRAY_POSITIONS, tube_vertices},
                          {NOOK_BAKE_ARRAY_NORMALS, tube_vertices},
                          {NOOK_BAKE_ARRAY_TRIANGLES, tube_triangles},
                          {NOOK_BAKE_ARRAY_JOINTS, tube_vertices},
                          {NOOK_BAKE_ARRAY_WEIGHTS, tube_vertices}};
  std::vector<unsigned char> out(1 << 16, 0xa5);
  for (const Array& a : arrays) {
    INFO("array " << a.array);
    for (const std::size_t stride :
         {SIZE_MAX, SIZE_MAX - 3, SIZE_MAX / a.count + 1, std::size_t{PTRDIFF_MAX} / a.count + 1}) {
      CHECK(nook_bake_character_read(character.get(), a.array, out.data(), a.count, stride) ==
            NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(message_has("stride"));
    }
  }
  CHECK(out == std::vector<unsigned char>(out.size(), 0xa5));
}
