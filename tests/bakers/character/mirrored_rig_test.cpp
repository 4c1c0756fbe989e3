// Mirrored rigs as exporters write them: which side is the front, and what the import warns of. The AO is
// equal to the AO of the same body without a mirror, by ray tracing and by a model.
#include "bakers/import/fronts.h"
#include "bakers/import/posed_normals.h"
#include "bakers/import/weld.h"
#include "bakers/measure/character/character_error.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "tests/bakers/character/unfitted_model.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

// A closed body with hollows, different on all sides, so that neither its AO nor its places survive a mirror.
struct Body {
  std::vector<float> position, normal;
  std::vector<std::uint16_t> index;
};

Body body_at(float x) {
  const Tube tube;
  Body body;
  for (std::size_t v = 0; v < tube.position.size(); v += 3) {
    const float y = tube.position[v + 1], wide = 1.1f + std::cos(6 * y);
    body.position.insert(body.position.end(), {x + wide * tube.position[v] + 0.1f * y * y, y,
                                               wide * tube.position[v + 2] + 0.2f * std::sin(2 * y)});
  }
  body.index = tube.index;
  std::vector<Vec3> place, normal;
  std::vector<std::array<std::uint32_t, 3>> triangle;
  for (std::size_t v = 0; v < body.position.size(); v += 3)
    place.push_back({body.position[v], body.position[v + 1], body.position[v + 2]});
  for (std::size_t i = 0; i < body.index.size(); i += 3)
    triangle.push_back({body.index[i], body.index[i + 1], body.index[i + 2]});
  vertex_normals(triangle, place, normal);
  for (const Vec3 n : normal) body.normal.insert(body.normal.end(), {n.x, n.y, n.z});
  return body;
}

void mirror_x(std::vector<float>& vectors) {
  for (std::size_t i = 0; i < vectors.size(); i += 3) vectors[i] = -vectors[i];
}

void turn_round(Body& body) {
  for (std::size_t i = 0; i < body.index.size(); i += 3) std::swap(body.index[i + 1], body.index[i + 2]);
}

// A skinned mesh node below the armature, nodes 0 to 2 as in tube_file, with weights of its own.
int add_body(GltfBuilder& file, const Body& body, bool with_normals, const char* name, int joint = -1) {
  std::vector<std::uint8_t> joints;
  std::vector<float> weights;
  for (std::size_t v = 0; v < body.position.size(); v += 3) {
    const float tip = body.position[v + 1] < 1 ? 0.0f : 1.0f;
    joints.insert(joints.end(),
                  {std::uint8_t(joint < 0 ? 0 : joint), std::uint8_t(joint < 0 ? 1 : joint), 0, 0});
    weights.insert(weights.end(), {1 - tip, tip, 0, 0});
  }
  Json attributes = {{"POSITION", file.add_floats(body.position, "VEC3")},
                     {"JOINTS_0", file.add(joints, "VEC4", 5121)},
                     {"WEIGHTS_0", file.add_floats(weights, "VEC4")}};
  if (with_normals) attributes["NORMAL"] = file.add_floats(body.normal, "VEC3");
  const Json primitive = {{"attributes", attributes}, {"indices", file.add(body.index, "SCALAR", 5123)}};
  file.document["meshes"].push_back({{"name", name}, {"primitives", Json::array({primitive})}});
  const int node = int(file.document["nodes"].size());
  file.document["nodes"].push_back(
      {{"name", name}, {"mesh", file.document["meshes"].size() - 1}, {"skin", 0}});
  file.document["nodes"][0]["children"].push_back(node);
  return node;
}

// tube_file without its tube.
GltfBuilder skeleton_file() {
  GltfBuilder file = tube_file();
  file.document["nodes"].erase(3);
  file.document["nodes"][0]["children"] = Json::array({1});
  file.document["meshes"] = Json::array();
  return file;
}

void set_inverse_bind(GltfBuilder& file, const std::vector<std::vector<float>>& columns) {
  std::vector<float> all;
  for (const std::vector<float>& matrix : columns) all.insert(all.end(), matrix.begin(), matrix.end());
  file.document["skins"][0]["inverseBindMatrices"] = file.add_floats(all, "MAT4");
}

// Mirrored in x behind a move along y.
std::vector<float> mirror_columns(float y) {
  std::vector<float> columns = translation_columns(0, y, 0);
  columns[0] = -1;
  return columns;
}

GltfBuilder plain_file(bool with_normals = true) {
  GltfBuilder file = skeleton_file();
  add_body(file, body_at(0.2f), with_normals, "body");
  return file;
}

// An armature scaled by -1 whose mesh is in its own space.
GltfBuilder mirrored_armature(bool with_normals) {
  GltfBuilder file = skeleton_file();
  Body body = body_at(0.2f);
  mirror_x(body.position);
  mirror_x(body.normal);
  turn_round(body);
  add_body(file, body, with_normals, "body");
  file.document["nodes"][0]["scale"] = {-1, 1, 1};
  return file;
}

// The same as Blender's exporter writes it. Positions and normals are in the world's space, where the body is
// what the armature shows. The order of corners is the one of the object.
GltfBuilder blender_armature(bool with_normals) {
  GltfBuilder file = skeleton_file();
  Body body = body_at(0.2f);
  turn_round(body);
  add_body(file, body, with_normals, "body");
  file.document["nodes"][0]["scale"] = {-1, 1, 1};
  set_inverse_bind(file, {mirror_columns(0), mirror_columns(-1)});
  return file;
}

// An object with a scale of -1 below a plain armature: the exporter applies the scale to positions and
// normals of a skinned mesh, and leaves none on its node.
GltfBuilder blender_object(bool with_normals) {
  GltfBuilder file = skeleton_file();
  Body body = body_at(0.2f);
  turn_round(body);
  add_body(file, body, with_normals, "body");
  return file;
}

// Joints that are scaled by -1 in the bind pose as well.
GltfBuilder mirrored_joints(bool with_normals) {
  GltfBuilder file = plain_file(with_normals);
  file.document["nodes"][1]["scale"] = {-1, 1, 1};
  set_inverse_bind(file, {mirror_columns(0), mirror_columns(-1)});
  return file;
}

// A mirrored armature whose mesh node hangs elsewhere: glTF ignores the transform of that node.
GltfBuilder mesh_apart(bool with_normals) {
  GltfBuilder file = mirrored_armature(with_normals);
  file.document["nodes"][0]["children"] = Json::array({1});
  file.document["scenes"][0]["nodes"].push_back(3);
  return file;
}

void check_equal_meshes(const SkinnedMesh& mesh, const SkinnedMesh& plain) {
  REQUIRE(mesh.triangle.size() == plain.triangle.size());
  REQUIRE(mesh.position.size() == plain.position.size());
  std::vector<Vec3> normal, plain_normal;
  vertex_normals(mesh.triangle, mesh.position, normal);
  vertex_normals(plain.triangle, plain.position, plain_normal);
  for (std::size_t v = 0; v < normal.size(); ++v) {
    // Sums of a few products of floats of size 1.
    REQUIRE(distance(mesh.position[v], plain.position[v]) < 1e-6f);
    REQUIRE(distance(normal[v], plain_normal[v]) < 1e-5f);
  }
}

// The same rays from places and normals that differ in the last digits: a ray that grazes an edge may change.
void check_equal_ao(std::span<const float> ao, std::span<const float> plain) {
  REQUIRE(ao.size() == plain.size());
  double sum = 0, darkest = 1;
  for (std::size_t v = 0; v < ao.size(); ++v) {
    sum += std::abs(double(ao[v]) - double(plain[v]));
    darkest = std::min(darkest, double(plain[v]));
  }
  CHECK(sum / double(ao.size()) < 1e-3);
  CHECK(darkest < 0.8);  // the body occludes itself, so that a wrong place shows
}

std::vector<float> traced(const ImportedCharacter& character, const Pose& pose) {
  const AoTargets targets = trace_character_ao(character.mesh, {&pose, 1}, 256, 1);
  std::vector<float> out;
  for (const std::uint16_t value : targets.row(0)) out.push_back(float(value) * AoTargets::scale);
  return out;
}

Pose default_pose(const ImportedCharacter& character) {
  return bone_matrices(character, default_locals(character.nodes), nullptr);
}

}  // namespace

TEST_CASE("mirrored rigs give the AO of the plain rig") {
  const bool with_normals = GENERATE(true, false);
  CAPTURE(with_normals);
  using Make = GltfBuilder (*)(bool);
  const Make make = GENERATE(&mirrored_armature, &blender_armature, &mirrored_joints, &mesh_apart);
  const ImportedCharacter plain = load(plain_file()), mirrored = load(make(with_normals));
  CHECK(mirrored.warnings.empty());
  check_equal_meshes(mirrored.mesh, plain.mesh);
  for (const float time_s : {0.0f, 1.0f}) {
    const Pose pose = sample_clip(plain, 0, time_s);
    check_equal_ao(traced(mirrored, pose), traced(plain, pose));
    check_equal_ao(measure::predict_ao(unfitted_model(mirrored), pose),
                   measure::predict_ao(unfitted_model(plain), pose));
  }
}

TEST_CASE("the normals of a mirrored object decide, and without them it is named") {
  const ImportedCharacter plain = load(plain_file()), good = load(blender_object(true)),
                          bad = load(blender_object(false));
  check_equal_meshes(good.mesh, plain.mesh);
  CHECK(good.warnings.empty());
  CHECK(signed_volume(bad.mesh) < 0);
  CHECK(has_warning(bad.warnings, "node \"body\" (mesh \"body\" primitive 0"));
  CHECK(has_warning(bad.warnings, "is inside out"));
}

TEST_CASE("the normals decide for each primitive, as in a body with a mirrored half") {
  GltfBuilder file = skeleton_file(), both = skeleton_file();
  Body left = body_at(-0.6f), right = body_at(0.6f);
  add_body(both, left, false, "left");
  add_body(both, right, false, "right");
  turn_round(right);
  add_body(file, left, true, "left");
  add_body(file, right, true, "right");
  const ImportedCharacter mirrored = load(file), plain = load(both);
  CHECK(mirrored.warnings.empty());
  check_equal_meshes(mirrored.mesh, plain.mesh);
}

TEST_CASE("normals decide that are right for most, but not for all vertices") {
  Body body = body_at(0.2f);
  turn_round(body);
  for (std::size_t v = 0; v < body.normal.size() / 3; v += 4) {
    for (std::size_t i = 0; i < 3; ++i) body.normal[3 * v + i] = v % 8 == 0 ? NAN : -body.normal[3 * v + i];
  }
  GltfBuilder file = skeleton_file();
  add_body(file, body, true, "body");
  CHECK(signed_volume(load(file).mesh) > 0);
  // Normals that say nothing leave the order of the corners.
  std::fill(body.normal.begin(), body.normal.end(), 0.0f);
  GltfBuilder zero = skeleton_file();
  add_body(zero, body, true, "body");
  CHECK(has_warning(load(zero).warnings, "is inside out"));
}

TEST_CASE("a rigid part with a scale of -1 faces outside, with and without normals") {
  for (const bool with_normals : {true, false}) {
    GltfBuilder file = plain_file(), as_blender = plain_file();
    Body part = body_at(0);
    const auto add_part = [&](GltfBuilder& to, const Body& shape) {
      const int node = add_body(to, shape, with_normals, "part");
      to.document["nodes"][std::size_t(node)].erase("skin");
      to.document["nodes"][std::size_t(node)]["scale"] = {-1, 1, 1};
      to.document["nodes"][0]["children"].erase(to.document["nodes"][0]["children"].size() - 1);
      to.document["nodes"][2]["children"] = Json::array({node});
    };
    add_part(file, part);
    CHECK(load(file).warnings.empty());
    const float alone = signed_volume(load(plain_file()).mesh);
    CHECK(signed_volume(load(file).mesh) > 1.9f * alone);
    if (!with_normals) continue;
    // Corners in the order of the world: by the determinant alone they would turn round.
    turn_round(part);
    add_part(as_blender, part);
    CHECK(load(as_blender).warnings.empty());
    CHECK(signed_volume(load(as_blender).mesh) > 1.9f * alone);
  }
}

TEST_CASE("a half that the pose mirrors has the normals and the AO of the plain half") {
  const Body left = body_at(-0.7f), right = body_at(0.7f);
  GltfBuilder both = skeleton_file(), file = skeleton_file();
  for (GltfBuilder* f : {&both, &file}) {
    f->document["nodes"][2].erase("translation");
    set_inverse_bind(*f, {translation_columns(0, 0, 0), translation_columns(0, 0, 0)});
  }
  add_body(both, left, true, "left", 0);
  add_body(both, right, true, "right", 1);
  Body source = right;
  mirror_x(source.position);
  mirror_x(source.normal);
  turn_round(source);
  add_body(file, left, true, "left", 0);
  add_body(file, source, true, "right", 1);
  file.document["nodes"][2]["scale"] = {-1, 1, 1};
  const ImportedCharacter plain = load(both), mirrored = load(file);
  CHECK(mirrored.warnings.empty());
  const Pose pose = default_pose(mirrored), plain_pose = default_pose(plain);
  CHECK(pose[1].m[0] == -1);
  std::vector<Vec3> position, normal, plain_position, plain_normal;
  skin_positions(mirrored.mesh, pose, position);
  skin_positions(plain.mesh, plain_pose, plain_position);
  posed_normals(mirrored.mesh, pose, position, normal);
  posed_normals(plain.mesh, plain_pose, plain_position, plain_normal);
  for (std::size_t v = 0; v < position.size(); ++v) {
    REQUIRE(distance(position[v], plain_position[v]) < 1e-6f);
    REQUIRE(distance(normal[v], plain_normal[v]) < 1e-5f);
  }
  check_equal_ao(traced(mirrored, pose), traced(plain, plain_pose));

  // The same spheres in the pose; the key points come from the mirrored mesh.
  CharacterModel model = unfitted_model(mirrored), plain_model = unfitted_model(plain);
  for (std::size_t s = 0; s < model.spheres.size(); ++s) {
    REQUIRE(model.spheres[s].bone == plain_model.spheres[s].bone);
    model.spheres[s] = plain_model.spheres[s];
    if (model.spheres[s].bone == 1) model.spheres[s].centre.x *= -1;
  }
  const std::vector<float> ao = measure::predict_ao(model, pose),
                           plain_ao = measure::predict_ao(plain_model, plain_pose);
  for (std::size_t v = 0; v < ao.size(); ++v) CHECK(std::abs(ao[v] - plain_ao[v]) < 1e-3f);
}

TEST_CASE("a mirrored place of a whole pose changes neither traced nor modelled AO") {
  const ImportedCharacter plain = load(plain_file());
  const CharacterModel model = unfitted_model(plain);
  const Pose pose = sample_clip(plain, 0, 0.5f);
  Affine mirror;
  mirror.m[0] = -1;
  mirror.m[3] = 3;
  Pose placed;
  for (const Mat3x4& bone : pose) placed.push_back(to_float(mirror * to_double(bone)));
  const std::vector<float> ao = measure::predict_ao(model, placed),
                           plain_ao = measure::predict_ao(model, pose);
  for (std::size_t v = 0; v < ao.size(); ++v) CHECK(std::abs(ao[v] - plain_ao[v]) < 1e-4f);
  const std::vector<float> rays = traced(plain, placed), plain_rays = traced(plain, pose);
  double mean = 0;
  for (std::size_t v = 0; v < rays.size(); ++v) mean += double(rays[v] - plain_rays[v]);
  // Other rays, whose noise is 0.03 a vertex at most.
  CHECK(std::abs(mean / double(rays.size())) < 0.01);
}

TEST_CASE("a triangle between mirrored and other vertices gives no normal") {
  // A sheet in the plane z = 0 with the front in +z. Its last column follows a bone that mirrors in x.
  SkinnedMesh mesh;
  mesh.bones.resize(2);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 2; ++y) mesh.position.push_back({float(x), float(y), 0});
  for (std::size_t v = 0; v < 8; ++v) {
    const std::pair<std::uint16_t, float> bone{v < 4 ? 0 : 1, 1.0f};
    mesh.weights.push_back(make_weights({&bone, 1}));
  }
  for (std::uint32_t x = 0; x < 3; ++x) {
    mesh.triangle.push_back({2 * x, 2 * x + 2, 2 * x + 3});
    mesh.triangle.push_back({2 * x, 2 * x + 3, 2 * x + 1});
  }
  Pose pose(2);
  std::vector<std::array<std::uint32_t, 3>> storage;
  CHECK(posed_triangles(mesh, pose, storage).data() == mesh.triangle.data());
  pose[1].m[0] = -1;
  CHECK(posed_triangles(mesh, pose, storage).size() == 4);
  std::vector<Vec3> position, normal;
  skin_positions(mesh, pose, position);
  posed_normals(mesh, pose, position, normal);
  for (const Vec3 n : normal) CHECK(distance(n, {0, 0, 1}) < 1e-6f);
}

TEST_CASE("closed parts that are inside out are found, and open ones and cavities are not") {
  const auto parts_of_file = [](const GltfBuilder& file) { return load(file).warnings; };
  Body inside = body_at(0);
  for (float& value : inside.position) value *= 0.2f;
  for (std::size_t v = 0; v < inside.position.size(); v += 3) inside.position[v + 1] += 0.8f;
  Body wall = inside;
  turn_round(wall);
  SECTION("the wall of a cavity") {
    GltfBuilder file = skeleton_file();
    Body around = body_at(0);
    add_body(file, around, false, "around");
    add_body(file, wall, false, "cavity");
    CHECK(parts_of_file(file).empty());
  }
  SECTION("the same part outside of the other") {
    GltfBuilder file = skeleton_file();
    Body beside = body_at(2);
    add_body(file, beside, false, "beside");
    add_body(file, wall, false, "part");
    CHECK(has_warning(parts_of_file(file), "node \"part\""));
  }
  SECTION("an open part") {
    GltfBuilder file = skeleton_file();
    add_body(file, body_at(2), false, "beside");
    wall.index.resize(wall.index.size() - 3);
    add_body(file, wall, false, "part");
    CHECK(parts_of_file(file).empty());
  }
}
