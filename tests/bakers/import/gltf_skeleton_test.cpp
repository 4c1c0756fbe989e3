// Bones of synthetic files: bind poses, several skins, rigid parts, mirrored and uneven nodes.
#include "bakers/import/skinned_mesh.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

const float half = std::sqrt(0.5f);

// A tetrahedron with its right angle at the origin, facing outwards.
int add_tetrahedron(GltfBuilder& file, float size = 0.1f) {
  const int position = file.add_floats({0, 0, 0, size, 0, 0, 0, size, 0, 0, 0, size}, "VEC3");
  const int index = file.add(std::vector<std::uint8_t>{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, "SCALAR", 5121);
  const Json primitive = {{"attributes", {{"POSITION", position}}}, {"indices", index}};
  file.document["meshes"].push_back({{"name", "part"}, {"primitives", Json::array({primitive})}});
  return static_cast<int>(file.document["meshes"].size()) - 1;
}

int add_node(GltfBuilder& file, int parent, Json node) {
  Json& nodes = file.document["nodes"];
  nodes.push_back(std::move(node));
  const int index = static_cast<int>(nodes.size()) - 1;
  nodes[parent]["children"].push_back(index);
  return index;
}

std::size_t bone_named(const ImportedCharacter& character, const std::string& name) {
  for (std::size_t b = 0; b < character.mesh.bones.size(); ++b)
    if (character.mesh.bones[b].name == name) return b;
  FAIL("no bone " << name);
  return 0;
}

Pose default_pose(const ImportedCharacter& character) {
  return bone_matrices(character, default_locals(character.nodes), nullptr);
}

}  // namespace

TEST_CASE("bones have names, parents before children and frames at their joints") {
  GltfBuilder file = tube_file();
  // Child first in the skin's list: weights then name joint 0 for the tip.
  file.document["skins"][0]["joints"] = {2, 1};
  std::vector<float> inverse_bind = translation_columns(0, -1, 0);
  const std::vector<float> root = translation_columns(0, 0, 0);
  inverse_bind.insert(inverse_bind.end(), root.begin(), root.end());
  file.document["skins"][0]["inverseBindMatrices"] = file.add_floats(inverse_bind, "MAT4");
  const ImportedCharacter character = load(file);
  REQUIRE(character.mesh.bones.size() == 2);
  CHECK(character.mesh.bones[0].name == "root");
  CHECK(character.mesh.bones[0].parent == -1);
  CHECK(character.mesh.bones[1].name == "tip");
  CHECK(character.mesh.bones[1].parent == 0);
  CHECK(distance(transform_point(character.mesh.bones[1].frame_rest, {}), {0, 1, 0}) < 1e-6f);
  // The bottom's vertices belong to joint 0, the tip, in this file.
  CHECK(character.mesh.weights[character.mesh.file_to_welded[0]].bone[0] == 1);
}

TEST_CASE("a clip bends the tube about its joint") {
  const ImportedCharacter character = load(tube_file());
  std::vector<Vec3> posed;
  skin_positions(character.mesh, sample_clip(character, 0, 1), posed);
  for (std::size_t v = 0; v < posed.size(); ++v) {
    const Vec3 p = character.mesh.position[v];
    // A quarter turn about z at (0, 1, 0) takes (x, 1 + d) to (-d, 1 + x).
    const Vec3 turned{-(p.y - 1), 1 + p.x, p.z};
    const Vec3 expected = p.y < 1 ? p : p.y > 1 ? turned : 0.5f * p + 0.5f * turned;
    CHECK(distance(posed[v], expected) < 1e-5f);  // float matrices of size 2
  }
}

TEST_CASE("the default pose is not the rest pose") {
  GltfBuilder file = tube_file();
  file.document["nodes"][2]["rotation"] = {0, 0, half, half};
  const ImportedCharacter character = load(file);
  const ImportedCharacter plain = load(tube_file());
  CHECK(character.mesh.position == plain.mesh.position);
  for (const Mat3x4& m : rest_pose(character)) CHECK(is_identity(m, 0));
  const Pose pose = default_pose(character);
  CHECK(is_identity(pose[0], 1e-6f));
  CHECK(distance(transform_point(pose[1], {0, 2, 0}), {-1, 1, 0}) < 1e-6f);
}

TEST_CASE("the transform of a skinned mesh node is ignored, as glTF says") {
  GltfBuilder file = tube_file();
  file.document["nodes"][3]["translation"] = {5, 6, 7};
  file.document["nodes"][3]["rotation"] = {half, 0, 0, half};
  CHECK(load(file).mesh.position == load(tube_file()).mesh.position);
}

TEST_CASE("nodes between joints move them without being bones") {
  GltfBuilder file = tube_file();
  Json& nodes = file.document["nodes"];
  nodes.push_back({{"name", "between"}, {"translation", {0, 1, 0}}, {"children", Json::array({2})}});
  nodes[1]["children"] = Json::array({4});
  nodes[2].erase("translation");
  file.add_animation("slide");
  file.add_channel(4, "translation", {0, 1}, {0, 1, 0, 0, 3, 0});
  const ImportedCharacter character = load(file);
  REQUIRE(character.mesh.bones.size() == 2);
  CHECK(character.mesh.bones[1].parent == 0);
  const Pose pose = sample_clip(character, find_clip(character, "slide"), 0.5f);
  CHECK(distance(transform_point(pose[1], {0, 1, 0}), {0, 2, 0}) < 1e-6f);
}

TEST_CASE("two skins share bones where they agree") {
  GltfBuilder file = tube_file();
  // The second skin lists a joint that the first has not, and lacks the root.
  const int finger = add_node(file, 2, {{"name", "finger"}, {"translation", {0, 0.5, 0}}});
  add_node(file, 0, {{"name", "glove"}, {"mesh", 0}, {"skin", 1}});
  std::vector<float> inverse_bind = translation_columns(0, -1, 0);
  SECTION("bound alike") {
    const std::vector<float> at_finger = translation_columns(0, -1.5f, 0);
    inverse_bind.insert(inverse_bind.end(), at_finger.begin(), at_finger.end());
    file.document["skins"].push_back(
        {{"joints", {2, finger}}, {"inverseBindMatrices", file.add_floats(inverse_bind, "MAT4")}});
    const ImportedCharacter character = load(file);
    CHECK(character.mesh.bones.size() == 3);
    CHECK(character.mesh.bones[bone_named(character, "finger")].parent ==
          static_cast<std::int32_t>(bone_named(character, "tip")));
  }
  SECTION("the second mesh in centimetres of its own") {
    for (int i : {0, 5, 10}) inverse_bind[i] = 0.01f;
    std::vector<float> at_finger = inverse_bind;
    at_finger[13] = -1.5f;
    inverse_bind.insert(inverse_bind.end(), at_finger.begin(), at_finger.end());
    file.document["skins"].push_back(
        {{"joints", {2, finger}}, {"inverseBindMatrices", file.add_floats(inverse_bind, "MAT4")}});
    const ImportedCharacter character = load(file);
    CHECK(character.mesh.bones.size() == 3);
    const std::size_t second = character.mesh.file_to_welded[Tube::file_vertices + Tube::file_vertices - 1];
    CHECK(distance(character.mesh.position[second], {0, 0.02f, 0}) < 1e-6f);
  }
  SECTION("bound differently: bones of their own") {
    std::vector<float> at_finger = translation_columns(0, -1.7f, 0.3f);
    inverse_bind.insert(inverse_bind.end(), at_finger.begin(), at_finger.end());
    file.document["skins"].push_back(
        {{"joints", {2, 1}}, {"inverseBindMatrices", file.add_floats(inverse_bind, "MAT4")}});
    const ImportedCharacter character = load(file);
    REQUIRE(character.mesh.bones.size() == 3);
    // The top-most shared joint, the root, places the second mesh; so the tip differs.
    const std::size_t second = bone_named(character, "tip_2");
    CHECK(character.mesh.bones[second].parent == static_cast<std::int32_t>(bone_named(character, "root")));
    CHECK(distance(transform_point(character.mesh.bones[second].frame_rest, {}), {0, -0.7f, 0.3f}) < 1e-6f);
  }
}

TEST_CASE("a mesh without a skin rides on the joint above it") {
  GltfBuilder file = tube_file();
  const int mesh = add_tetrahedron(file);
  add_node(file, 2, {{"name", "hat"}, {"mesh", mesh}, {"translation", {0, 1, 0}}});
  const ImportedCharacter character = load(file);
  CHECK(character.mesh.bones.size() == 2);
  REQUIRE(character.mesh.primitives.size() == 2);
  CHECK(character.mesh.primitives[1].mesh_name == "part");
  CHECK(character.mesh.primitives[1].first_vertex == Tube::file_vertices);
  const std::uint32_t corner = character.mesh.file_to_welded[Tube::file_vertices];
  CHECK(distance(character.mesh.position[corner], {0, 2, 0}) < 1e-6f);
  CHECK(character.mesh.weights[corner].bone[0] == bone_named(character, "tip"));
  CHECK(character.mesh.weights[corner].weight[0] == 1);
}

TEST_CASE("a file without skins and clips is a rigid prop with a bone for each root") {
  GltfBuilder file = tube_file();
  file.document["nodes"][3].erase("skin");
  file.document.erase("animations");
  const int mesh = add_tetrahedron(file);
  file.document["scenes"][0]["nodes"].push_back(file.document["nodes"].size());
  file.document["nodes"].push_back({{"name", "lid"}, {"mesh", mesh}, {"translation", {0, 3, 0}}});
  const ImportedCharacter prop = load(file);
  CHECK(has_warning(prop.warnings, "rigid prop with 2 bones"));
  REQUIRE(prop.mesh.bones.size() == 2);
  CHECK(prop.mesh.primitives.size() == 2);
  const std::uint32_t corner = prop.mesh.file_to_welded[Tube::file_vertices];
  CHECK(prop.mesh.weights[corner].bone[0] == bone_named(prop, "lid"));
  CHECK(distance(prop.mesh.position[corner], {0, 3, 0}) < 1e-6f);
  // The default scene is the rest pose.
  for (const Mat3x4& bone : bone_matrices(prop, default_locals(prop.nodes), nullptr))
    CHECK(is_identity(bone, 1e-6f));
}

TEST_CASE("a mesh on an animated node gets a bone, one that nothing moves is left out") {
  GltfBuilder file = tube_file();
  const int mesh = add_tetrahedron(file);
  const int wheel = add_node(file, 0, {{"name", "wheel"}, {"translation", {2, 0, 0}}});
  add_node(file, wheel, {{"name", "spoke"}, {"mesh", mesh}, {"translation", {0, 0, 1}}});
  file.document["scenes"][0]["nodes"].push_back(file.document["nodes"].size());
  file.document["nodes"].push_back({{"name", "floor"}, {"mesh", mesh}});
  file.add_animation("roll");
  file.add_channel(wheel, "rotation", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});  // half a turn about y
  const ImportedCharacter character = load(file);
  CHECK(character.mesh.bones.size() == 3);
  CHECK(character.mesh.primitives.size() == 2);
  CHECK(has_warning(character.warnings, "\"floor\" has no skin"));
  const Pose pose = sample_clip(character, find_clip(character, "roll"), 1);
  const std::uint32_t corner = character.mesh.file_to_welded[Tube::file_vertices];
  CHECK(distance(character.mesh.position[corner], {2, 0, 1}) < 1e-6f);
  CHECK(distance(transform_point(pose[bone_named(character, "wheel")], character.mesh.position[corner]),
                 {2, 0, -1}) < 1e-5f);
}

TEST_CASE("rigid parts alone are a character") {
  GltfBuilder file;
  const int mesh = add_tetrahedron(file);
  file.document["nodes"] = {{{"name", "base"}, {"children", Json::array({1})}},
                            {{"name", "arm"}, {"mesh", mesh}, {"translation", {0, 1, 0}}}};
  file.add_animation("turn");
  file.add_channel(1, "rotation", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
  const ImportedCharacter character = load(file);
  REQUIRE(character.mesh.bones.size() == 1);
  CHECK(character.mesh.bones[0].name == "arm");
  CHECK(signed_volume(character.mesh) > 0);
}

TEST_CASE("a mirrored node flips the winding back") {
  GltfBuilder file = tube_file();
  SECTION("above the skeleton") {
    file.document["nodes"][0]["scale"] = {-1, 1, 1};
    const ImportedCharacter character = load(file);
    CHECK(signed_volume(character.mesh) > 0);
    for (const Mat3x4& m : default_pose(character)) CHECK(is_identity(m, 1e-6f));
  }
  SECTION("of a rigid part") {
    const int mesh = add_tetrahedron(file, 1);
    add_node(file, 2, {{"name", "hand"}, {"mesh", mesh}, {"scale", {1, 1, -1}}});
    const float with_part = signed_volume(load(file).mesh);
    // The tetrahedron alone holds 1 / 6.
    CHECK(std::abs(with_part - signed_volume(load(tube_file()).mesh) - 1.0f / 6) < 1e-5f);
  }
}

TEST_CASE("uniform scale stays, uneven scale is replaced by the nearest similarity with a warning") {
  GltfBuilder file = tube_file();
  file.add_animation("grow");
  file.add_channel(2, "scale", {0, 1}, {1, 1, 1, 3, 3, 3});
  SECTION("uniform") {
    const ImportedCharacter character = load(file);
    CHECK(character.warnings.empty());
    const Pose pose = sample_clip(character, 1, 0.5f);
    CHECK(distance(transform_point(pose[1], {0, 2, 0}), {0, 3, 0}) < 1e-5f);
  }
  SECTION("uneven") {
    file.add_animation("squash");
    file.add_channel(2, "scale", {0, 1}, {1, 1, 1, 1, 4, 1});
    const ImportedCharacter character = load(file);
    CHECK(has_warning(character.warnings, "\"tip\" is sheared or scaled unevenly"));
    const Pose pose = sample_clip(character, 2, 1);
    // |diag(1, 4, 1) - s I| has its minimum at s = (1 + 4 + 1) / 3; the joint at (0, 1, 0) stays.
    CHECK(distance(transform_point(pose[1], {0, 1, 0}), {0, 1, 0}) < 1e-5f);
    CHECK(distance(transform_vector(pose[1], {1, 0, 0}), {2, 0, 0}) < 1e-5f);
    CHECK(distance(transform_vector(pose[1], {0, 1, 0}), {0, 2, 0}) < 1e-5f);
  }
  SECTION("nothing left") {
    file.add_animation("vanish");
    file.add_channel(2, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});
    const ImportedCharacter character = load(file);
    const Pose pose = sample_clip(character, 2, 1);
    for (const float v : pose[1].m) CHECK(std::isfinite(v));
  }
}

TEST_CASE("joints without vertices are bones, skins that no mesh uses are not") {
  GltfBuilder file = tube_file();
  const int leaf = add_node(file, 2, {{"name", "leaf"}});
  file.document["skins"][0].erase("inverseBindMatrices");
  file.document["skins"][0]["joints"].push_back(leaf);
  file.document["skins"].push_back({{"joints", Json::array({0})}});
  const ImportedCharacter character = load(file);
  CHECK(character.mesh.bones.size() == 3);
  CHECK(character.mesh.bones[2].name == "leaf");
}

TEST_CASE("a thousand bones in a chain load") {
  GltfBuilder file = tube_file();
  int parent = 2;
  for (int i = 0; i < 998; ++i) {
    parent = add_node(file, parent, {{"name", "link"}, {"translation", {0, 0.001, 0}}});
    file.document["skins"][0]["joints"].push_back(parent);
  }
  file.document["skins"][0].erase("inverseBindMatrices");
  const ImportedCharacter character = load(file);
  REQUIRE(character.mesh.bones.size() == 1000);
  CHECK(character.mesh.bones[999].parent == 998);
  CHECK(character.mesh.bones[999].name != character.mesh.bones[998].name);
}
