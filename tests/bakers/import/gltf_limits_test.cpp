// Files that ask for more than they hold: memory, other files, and what nobody here reads.
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "bakers/import/static_scene.h"
#include "platform/peak_memory.h"
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
  return text.find(part) != std::string::npos;
}

// An accessor of zeros that costs no bytes in the file.
int add_zeros(GltfBuilder& file, std::size_t count, const char* type, int component_type) {
  file.document["accessors"].push_back({{"componentType", component_type}, {"count", count}, {"type", type}});
  return static_cast<int>(file.document["accessors"].size()) - 1;
}

// An empty folder that is gone afterwards.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("nook_gltf_limits_" + std::to_string(getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "inner");
  }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const std::string& name) const { return path_ / name; }

 private:
  fs::path path_;
};

void write(const fs::path& path, const void* data, std::size_t size) {
  std::ofstream(path, std::ios::binary).write(static_cast<const char*>(data), std::streamsize(size));
}
void write_gltf(const fs::path& path, const GltfBuilder& file, const std::string& buffer_uri) {
  const std::vector<std::byte> text = file.gltf(buffer_uri);
  write(path, text.data(), text.size());
}

}  // namespace

TEST_CASE("the demands of a small file are bounded before it is read") {
  GltfBuilder file = tube_file();
  Json& primitive = file.document["meshes"][0]["primitives"][0];
  const std::size_t before = platform::peak_bytes();
  SECTION("sets of joints") {
    const std::size_t vertices = 4'000'000;
    primitive["attributes"]["POSITION"] = add_zeros(file, vertices, "VEC3", 5126);
    const int joints = add_zeros(file, vertices, "VEC4", 5121);
    const int weights = add_zeros(file, vertices, "VEC4", 5126);
    for (int set = 0; set < 100; ++set) {
      primitive["attributes"]["JOINTS_" + std::to_string(set)] = joints;
      primitive["attributes"]["WEIGHTS_" + std::to_string(set)] = weights;
    }
    CHECK(contains(
        failure_of(file),
        "too many joints: 100 sets of joints and weights for 4000000 vertices (need at most 16 sets"));
  }
  SECTION("elements of all sets of joints") {
    const std::size_t vertices = 9'000'000;
    primitive["attributes"]["POSITION"] = add_zeros(file, vertices, "VEC3", 5126);
    for (int set = 0; set < 4; ++set) {
      primitive["attributes"]["JOINTS_" + std::to_string(set)] = add_zeros(file, vertices, "VEC4", 5121);
      primitive["attributes"]["WEIGHTS_" + std::to_string(set)] = add_zeros(file, vertices, "VEC4", 5126);
    }
    CHECK(contains(failure_of(file), "too many joints: 4 sets of joints and weights for 9000000 vertices"));
  }
  SECTION("inverse bind matrices") {
    file.document["skins"][0]["inverseBindMatrices"] = add_zeros(file, 1 << 24, "MAT4", 5126);
    CHECK(contains(failure_of(file), "16777216 inverse bind matrices for 2 joints"));
  }
  SECTION("animation keys") {
    file.document["animations"][0]["samplers"][0] = {{"input", add_zeros(file, 1 << 24, "SCALAR", 5126)},
                                                     {"output", add_zeros(file, 1 << 24, "VEC4", 5126)}};
    CHECK(contains(failure_of(file), "too many animation keys"));
  }
  SECTION("vertices") {
    primitive["attributes"]["POSITION"] = add_zeros(file, 1 << 24, "VEC3", 5126);
    CHECK(contains(failure_of(file), "too many vertices"));
  }
  SECTION("buffers in all") {
    for (int i = 0; i < 3; ++i) {
      file.document["buffers"].push_back({{"byteLength", 1 << 30}, {"uri", "a.bin"}});
    }
    const std::string text = file.document.dump();
    CHECK(
        contains(failure_when([&] { import_gltf(GltfBuilder::bytes_of(text)); }), "more than 2 GiB in all"));
  }
  SECTION("JSON values") {
    std::string text = R"({"asset":{"version":"2.0","extras":[0)";
    for (int i = 0; i < (1 << 24); ++i) text += ",0";
    const std::vector<std::byte> bytes = GltfBuilder::bytes_of(text + "]}}");
    CHECK(contains(failure_when([&] { import_gltf(bytes); }), "JSON has more than 16777216 values"));
  }
  // Positions of 9 million vertices are 108 MB, read for the sake of their count, and the text above is
  // copied.
  // The address sanitizer keeps 256 MB of freed memory.
  CHECK(platform::peak_bytes() - before < 700'000'000);
}

TEST_CASE("images are not opened where they are not used") {
  const Folder folder;
  GltfBuilder file = tube_file();
  SECTION("a pipe, which would wait for a writer") {
    REQUIRE(mkfifo((folder / "picture.png").c_str(), 0600) == 0);
    file.document["images"] = Json::array({{{"uri", "picture.png"}}});
  }
  SECTION("a file of 9 GB") {
    std::ofstream(folder / "picture.png").put('x');
    fs::resize_file(folder / "picture.png", 9'000'000'000);
    file.document["images"] = Json::array({{{"uri", "picture.png"}}});
  }
  write_gltf(folder / "tube.gltf", file, "");
  const std::size_t before = platform::peak_bytes();
  CHECK(import_gltf(folder / "tube.gltf").mesh.vertex_count() == Tube::welded_vertices);
  CHECK(import_static_scene(folder / "tube.gltf").triangle.size() == Tube::triangles);
  CHECK(platform::peak_bytes() - before < 100'000'000);
}

TEST_CASE("only regular files in the file's own folder are read") {
  const Folder folder;
  const GltfBuilder file = tube_file();
  const std::vector<unsigned char>& data = file.buffer();
  const auto import = [&](const std::string& name, LinkedFiles linked = LinkedFiles::folder) {
    return failure_when([&] { import_gltf(folder / name, {linked}); });
  };
  SECTION("a file beside it, or further down") {
    write(folder / "tube.bin", data.data(), data.size());
    write(folder / "inner/a tube.bin", data.data(), data.size());
    write_gltf(folder / "tube.gltf", file, "tube.bin");
    CHECK(import("tube.gltf") == "");
    write_gltf(folder / "tube.gltf", file, "inner/../inner/a%20tube.bin");
    CHECK(import("tube.gltf") == "");
  }
  SECTION("a file further up, unless it is allowed") {
    write(folder / "tube.bin", data.data(), data.size());
    for (const char* uri : {"../tube.bin", "%2e%2e/tube.bin", "x/../../tube.bin"}) {
      write_gltf(folder / "inner/tube.gltf", file, uri);
      CHECK(contains(import("inner/tube.gltf"), "tube.bin\", which is outside the folder of this file"));
      fs::create_directories(folder / "inner/x");
      CHECK(import("inner/tube.gltf", LinkedFiles::anywhere) == "");
    }
  }
  SECTION("a file in the current folder") {
    write(folder / "tube.bin", data.data(), data.size());
    write_gltf(folder / "inner/tube.gltf", file, "tube.bin");
    const fs::path before = fs::current_path();
    fs::current_path(folder / "");
    CHECK(contains(import("inner/tube.gltf"), "\"tube.bin\", which does not exist"));
    fs::current_path(before);
  }
  SECTION("a pipe, which would wait for a writer") {
    REQUIRE(mkfifo((folder / "tube.bin").c_str(), 0600) == 0);
    write_gltf(folder / "tube.gltf", file, "tube.bin");
    CHECK(contains(import("tube.gltf"), "\"tube.bin\", which is not a regular file"));
  }
  SECTION("a file without end") {
    write_gltf(folder / "tube.gltf", file, "zero");
    fs::create_symlink("/dev/zero", folder / "zero");
    CHECK(contains(import("tube.gltf"), "\"zero\", a link that leads outside"));
    CHECK(contains(import("tube.gltf", LinkedFiles::anywhere), "\"zero\", which is not a regular file"));
  }
  SECTION("a file of 3 GB") {
    std::ofstream(folder / "tube.bin").put('x');
    fs::resize_file(folder / "tube.bin", 3'000'000'000);
    write_gltf(folder / "tube.gltf", file, "tube.bin");
    CHECK(contains(import("tube.gltf"), "more than 2 GiB"));
    fs::rename(folder / "tube.bin", folder / "tube.glb");
    CHECK(contains(import("tube.glb"), "more than 2 GiB"));
  }
}

TEST_CASE("extensions that a file requires are read or refused by name") {
  GltfBuilder file = tube_file();
  Json& required = file.document["extensionsRequired"];
  SECTION("unknown ones") {
    required = {"ACME_teapots", "KHR_texture_transform", "ACME_spoons"};
    CHECK(contains(failure_of(file), "requires ACME_teapots, ACME_spoons, which Nook does not read"));
  }
#if !NOOK_DRACO
  SECTION("Draco") {
    required = {"KHR_draco_mesh_compression"};
    CHECK(contains(failure_of(file), "KHR_draco_mesh_compression"));
    CHECK(contains(failure_of(file), "gltf-transform copy"));
  }
#endif
  SECTION("a draft of meshopt") {
    required = {"KHR_mesh_quantization", "MESHOPT_compression"};
    CHECK(contains(failure_of(file), "gltfpack"));
  }
  SECTION("those of materials and lights") {
    required = {"KHR_materials_unlit", "KHR_lights_punctual", "KHR_mesh_quantization"};
    CHECK(failure_of(file) == "");
  }
  SECTION("scenes as well") {
    required = {"ACME_teapots"};
    CHECK(contains(failure_when([&] { import_static_scene(file.glb()); }), "ACME_teapots"));
  }
}

TEST_CASE("morph targets stand at their default weights") {
  const Tube tube;
  GltfBuilder file = tube_file(tube);
  Json& mesh = file.document["meshes"][0];
  std::vector<float> up(tube.position.size(), 0.0f), out(tube.position.size(), 0.0f);
  for (std::size_t v = 0; v < Tube::file_vertices; ++v) {
    up[3 * v + 1] = 1;
    out[3 * v] = tube.position[3 * v];
  }
  mesh["primitives"][0]["targets"] = {{{"POSITION", file.add_floats(up, "VEC3")}},
                                      {{"POSITION", file.add_floats(out, "VEC3")}}};
  const auto vertex = [](const ImportedCharacter& c, std::size_t v) {
    return c.mesh.position[c.mesh.file_to_welded[v]];
  };
  const ImportedCharacter plain = load(file);
  CHECK_FALSE(has_warning(plain.warnings, "default weights"));
  mesh["weights"] = {0.5, 2.0};
  const ImportedCharacter morphed = load(file);
  CHECK(std::ranges::any_of(morphed.warnings, [](const std::string& text) {
    return text.find("ignores changes of the morph weights") != std::string::npos;
  }));
  CHECK(has_warning(morphed.warnings, "1 meshes have morph targets with default weights"));
  for (std::size_t v = 0; v < Tube::file_vertices; ++v) {
    const Vec3 p = vertex(plain, v);
    CHECK(distance(vertex(morphed, v), {3 * p.x, p.y + 0.5f, p.z}) < 1e-6f);
  }
  // A node's weights come before its mesh's.
  file.document["nodes"][3]["weights"] = {0.0, 0.0};
  CHECK(distance(vertex(load(file), 3), vertex(plain, 3)) == 0);
  file.document["nodes"][3]["weights"] = {1.0, 0.0};
  CHECK(distance(vertex(load(file), 3), vertex(plain, 3) + Vec3{0, 1, 0}) < 1e-6f);
  const StaticScene scene = import_static_scene(file.glb());
  CHECK(distance(scene.position[3], vertex(plain, 3) + Vec3{0, 1, 0}) < 1e-6f);

  file.document["nodes"][3]["weights"] = {1.0, 0.0, 1.0};
  CHECK(contains(failure_of(file), "has 2 morph targets but 3 default weights"));
  file.document["nodes"][3].erase("weights");
  mesh["primitives"][0]["targets"][0]["POSITION"] = file.add_floats({0, 1, 0}, "VEC3");
  CHECK(contains(failure_of(file), "morph target 0 moves 1 vertices, but the primitive has 47"));
}

TEST_CASE("names with a NUL character are refused") {
  GltfBuilder file = tube_file();
  const std::string name("ti\0p", 4);
  SECTION("of bones") {
    file.document["nodes"][2]["name"] = name;
    CHECK(contains(failure_of(file), "the name of node 2 (\"ti...\") holds a NUL character; rename it"));
  }
  SECTION("of clips") {
    file.document["animations"][0]["name"] = name;
    CHECK(contains(failure_of(file), "the name of animation 0 (\"ti...\") holds a NUL character"));
  }
  SECTION("of meshes") {
    file.document["meshes"][0]["name"] = name;
    CHECK(contains(failure_of(file), "the name of mesh 0 (\"ti...\") holds a NUL character"));
  }
}
