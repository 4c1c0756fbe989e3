// The sample as a user runs it: its pictures and exit codes; and its loader against Nook's own check of
// poses.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nook/nook.hpp>

#include "samples/gltf_viewer/viewed_character.h"
#include "tests/catch.h"
#include "tests/samples/sample_run.h"

using nook::test::Folder, nook::test::quoted;

namespace {

const std::string character = quoted(VIEWER_CHARACTER), baked = quoted(VIEWER_MODEL);

int run(const std::string& arguments) {
  return nook::test::exit_code(quoted(VIEWER) + " " + arguments + " 2> /dev/null");
}

std::vector<float> read(const std::filesystem::path& path) {
  return nook::test::read_picture<float>(path, 320, 240).values;
}

}  // namespace

TEST_CASE("sample gltf_viewer: its pictures move, and have neither holes nor black dots") {
  const Folder folder;
  REQUIRE(run(character + " " + baked + " --frames 2 --size 320x240 --out " + quoted(folder.path)) == 0);
  const std::vector<float> first = read(folder.path / "frame_0000.png"),
                           second = read(folder.path / "frame_0001.png");
  CHECK(first != second);
  for (const auto& picture : {first, second}) CHECK(*std::ranges::min_element(picture) > 0.05f);
}

TEST_CASE("sample gltf_viewer: faults have exit codes") {
  const Folder folder;
  const std::string out = " --out " + quoted(folder.path);
  CHECK(run("") == 2);
  CHECK(run(character + " " + baked + " --size 0x0" + out) == 2);
  CHECK(run(character + " " + baked + " --clip no_such_clip" + out) == 3);
  CHECK(run(character + " " + character + out) == 3);
  CHECK(run(baked + " " + baked + out) == 3);
}

TEST_CASE("sample gltf_viewer: its skinning is what Nook expects of the same matrices") {
  const viewer::CharacterFile file(VIEWER_CHARACTER);
  std::ifstream stream(VIEWER_MODEL, std::ios::binary);
  const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
  const nook::Context context;
  const nook::CharacterModel model(context, bytes.data(), bytes.size());
  REQUIRE(model.info().file_vertex_count == file.vertices.size());
  for (const viewer::Clip& clip : file.clips) {
    INFO(clip.name);
    const viewer::Pose pose = file.pose(&clip, 0.4f * clip.duration_s);
    const std::vector<glm::vec3> skinned = file.skinned(pose);
    std::vector<glm::vec3> rest_vertices;
    for (std::uint32_t v = 0; v < model.info().check_vertex_count; ++v)
      rest_vertices.push_back(skinned[model.check_vertex(v).vertex]);
    nook_pose_desc desc = nook::pose_desc();
    desc.kind = NOOK_POSE_SKINNING;
    desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
    desc.transforms = &pose.matrices[0][0][0];
    desc.transform_count = std::uint32_t(file.skins[0].joints.size());
    nook_pose_check_desc vertices = nook::pose_check_desc();
    vertices.vertex_count = std::uint32_t(rest_vertices.size());
    vertices.positions = &rest_vertices[0].x;
    const nook_pose_check_info check = model.check_pose(desc, vertices);
    INFO(check.text);
    CHECK(check.fault == NOOK_POSE_FAULT_NONE);
  }
}

namespace {

// A panel of one triangle that nodes below a moving root show; the corners are (0 0 0), (1 0 0) and (0 1 0).
std::filesystem::path write_panels(const Folder& folder, const std::string& nodes) {
  const std::filesystem::path path = folder.path / "parts.gltf";
  std::ofstream(path) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [)"
                      << nodes << R"(],
      "meshes": [{"name": "panel", "primitives": [{"attributes": {"POSITION": 0}}]}],
      "animations": [{"name": "turn", "samplers": [{"input": 1, "output": 2}],
                      "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                    {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 2, "type": "SCALAR"},
                    {"bufferView": 0, "byteOffset": 44, "componentType": 5126, "count": 2, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 68}], "buffers": [{"byteLength": 68, "uri":
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA="}]})";
  return path;
}

}  // namespace

TEST_CASE("sample gltf_viewer: it leaves out what a bake leaves out") {
  const Folder folder;
  const std::filesystem::path path = write_panels(folder, R"(
      {"name": "root", "children": [1, 2, 3, 4]}, {"name": "Body", "mesh": 0},
      {"name": "Hull", "mesh": 0, "extensions": {"KHR_node_visibility": {"visible": false}}},
      {"name": "Body_LOD1", "mesh": 0}, {"name": "Sword", "mesh": 0})");
  CHECK(viewer::CharacterFile(path).vertices.size() == 6);
  CHECK(viewer::CharacterFile(path, {"Sword"}).vertices.size() == 3);
}

TEST_CASE("sample gltf_viewer: it repeats the instances that a bake repeats") {
  const Folder folder;
  // The corners of the panel are the places of its instances.
  const std::filesystem::path path = write_panels(folder, R"({"name": "root", "children": [1]},
      {"name": "Body", "mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}}})");
  const viewer::CharacterFile file(path);
  REQUIRE(file.vertices.size() == 9);
  REQUIRE(file.triangles.size() == 9);
  for (std::size_t v = 0; v < 9; ++v) {
    const glm::vec3 wanted = file.vertices[v / 3].position + file.vertices[v % 3].position;
    CHECK(glm::distance(file.vertices[v].position, wanted) < 1e-6f);
    CHECK(glm::distance(file.vertices[v].normal, glm::vec3(0, 0, 1)) < 1e-6f);
  }
}
