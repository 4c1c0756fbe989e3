// Welding and validation of meshes that come from memory.
#include "bakers/import/weld.h"

#include "bakers/import/skinned_mesh.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;

namespace {

std::vector<Bone> bones(std::size_t count) {
  std::vector<Bone> out(count);
  for (std::size_t b = 0; b < count; ++b) {
    out[b].name = "bone_" + std::to_string(b);
    out[b].parent = b == 0 ? -1 : 0;
  }
  return out;
}

SkinWeights weights(std::vector<std::pair<std::uint16_t, float>> influences) {
  return make_weights(influences);
}

// Two triangles that share an edge, its ends split as at a seam.
FileMesh split_quad() {
  FileMesh mesh;
  mesh.bones = bones(2);
  mesh.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.weights.assign(6, weights({{0, 0.5f}, {1, 0.5f}}));
  mesh.triangle = {{0, 1, 2}, {3, 4, 5}};
  return mesh;
}

std::string failure_of(const FileMesh& mesh) {
  std::vector<std::string> warnings;
  try {
    weld(mesh, warnings, NOOK_ERROR_INVALID_ARGUMENT);
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
    return failure.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  INFO(text);
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("equal positions with equal weights become one vertex") {
  std::vector<std::string> warnings;
  const SkinnedMesh mesh = weld(split_quad(), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(mesh.vertex_count() == 4);
  CHECK(mesh.file_to_welded == std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3});
  CHECK(mesh.triangle[1] == std::array<std::uint32_t, 3>{0, 2, 3});
  REQUIRE(mesh.primitives.size() == 1);
  CHECK(mesh.primitives[0].vertex_count == 6);
  validate(mesh);
}

TEST_CASE("negative zero is zero") {
  FileMesh file = split_quad();
  file.position[3] = {-0.0f, 0.0f, -0.0f};
  std::vector<std::string> warnings;
  CHECK(weld(file, warnings, NOOK_ERROR_INVALID_ARGUMENT).vertex_count() == 4);
}

TEST_CASE("vertices that move apart stay apart") {
  FileMesh file = split_quad();
  file.weights[3] = weights({{0, 0.25f}, {1, 0.75f}});
  std::vector<std::string> warnings;
  CHECK(weld(file, warnings, NOOK_ERROR_INVALID_ARGUMENT).vertex_count() == 5);
}

TEST_CASE("weights are sorted, merged, cut at eight and normalised") {
  CHECK(weights({{3, 1.0f}, {1, 2.0f}, {3, 0.5f}, {7, 0.0f}, {8, -1.0f}}) == weights({{1, 2.0f}, {3, 1.5f}}));
  const SkinWeights w = weights({{5, 3.0f}, {4, 1.0f}});
  CHECK(w.bone[0] == 5);
  CHECK(w.weight[0] == 0.75f);
  CHECK(w.weight[1] == 0.25f);
  CHECK(w.weight[2] == 0);
  // Equal weights: the smaller bone first, whatever the order they came in.
  CHECK(weights({{9, 1}, {2, 1}}) == weights({{2, 1}, {9, 1}}));
  std::vector<std::pair<std::uint16_t, float>> many;
  for (std::uint16_t b = 0; b < 12; ++b) many.push_back({b, 1.0f + b});
  const SkinWeights cut = make_weights(many);
  CHECK(cut.bone[0] == 11);
  CHECK(cut.bone[7] == 4);
  float sum = 0;
  for (const float x : cut.weight) sum += x;
  CHECK(std::abs(sum - 1) < 1e-6f);  // eight roundings
  CHECK(weights({{1, 0.0f}}).weight[0] == 0);
}

TEST_CASE("arrays in memory become the same mesh") {
  const FileMesh file = split_quad();
  MeshArrays arrays;
  arrays.bones = file.bones;
  arrays.position = file.position;
  const std::vector<std::uint32_t> index = {0, 1, 2, 3, 4, 5};
  const std::vector<std::uint16_t> joint = {0, 1, 0, 1, 0, 1, 1, 0, 1, 0, 1, 0};
  const std::vector<float> weight(12, 2.0f);
  arrays.index = index;
  arrays.influences = 2;
  arrays.joint = joint;
  arrays.weight = weight;
  const FileMesh from_arrays = to_file_mesh(arrays, NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(from_arrays.weights == file.weights);
  CHECK(from_arrays.triangle == file.triangle);

  const std::vector<std::uint32_t> four = {0, 1, 2, 3};
  arrays.index = four;
  CHECK_THROWS_AS(to_file_mesh(arrays, NOOK_ERROR_INVALID_ARGUMENT), Failure);
  arrays.index = index;
  arrays.influences = 3;
  CHECK_THROWS_AS(to_file_mesh(arrays, NOOK_ERROR_INVALID_ARGUMENT), Failure);
  arrays.influences = 2;
  std::vector<float> bad = weight;
  bad[5] = NAN;
  arrays.weight = bad;
  CHECK_THROWS_AS(to_file_mesh(arrays, NOOK_ERROR_INVALID_ARGUMENT), Failure);
}

TEST_CASE("faults are named with their number and the first place") {
  FileMesh mesh = split_quad();
  SECTION("positions") {
    mesh.position[2].y = NAN;
    mesh.position[4].x = INFINITY;
    CHECK(contains(failure_of(mesh),
                   "position that is not finite or beyond 1e6 m: 2 of 6, the first has index 2"));
  }
  SECTION("no weight at all") {
    mesh.weights[1] = {};
    mesh.weights[5] = {};
    CHECK(contains(failure_of(mesh), "weights are all zero: 2 of 6, the first has index 1"));
  }
  SECTION("weights that were not normalised") {
    mesh.weights[1].weight[0] = 0.9f;
    CHECK(contains(failure_of(mesh), "sum 1: 1 of 6, the first has index 1"));
  }
  SECTION("negative weights") {
    mesh.weights[1].weight[1] = -0.5f;
    CHECK(contains(failure_of(mesh), "not finite or negative: 1 of 6"));
  }
  SECTION("bone indices") {
    mesh.weights[3].bone[1] = 2;
    CHECK(contains(failure_of(mesh), "bone index out of range: 1 of 6, the first has index 3"));
  }
  SECTION("vertex indices") {
    mesh.triangle[1][2] = 6;
    CHECK(contains(failure_of(mesh), "vertex index out of range: 1 of 2, the first has index 1"));
  }
  SECTION("no triangles") {
    mesh.triangle.clear();
    CHECK(contains(failure_of(mesh), "no triangles"));
  }
  SECTION("triangles without area only") {
    mesh.triangle = {{0, 1, 1}, {0, 2, 4}};
    CHECK(contains(failure_of(mesh), "no triangles: all 2 have no area"));
  }
  SECTION("no bones") {
    mesh.bones.clear();
    CHECK(contains(failure_of(mesh), "no bones"));
  }
  SECTION("too many bones") {
    mesh.bones = bones(65536);
    CHECK(contains(failure_of(mesh), "too many bones (got 65536, need at most 65535)"));
  }
  SECTION("children before parents") {
    mesh.bones[0].parent = 1;
    CHECK(contains(failure_of(mesh), "bone 0 (\"bone_0\") has parent 1"));
  }
  SECTION("a frame that is not orthonormal") {
    mesh.bones[1].frame_rest.m[0] = 2;
    CHECK(contains(failure_of(mesh), "bone 1 (\"bone_1\") has a rest frame"));
  }
  SECTION("a left-handed frame") {
    mesh.bones[1].frame_rest.m[10] = -1;
    CHECK(contains(failure_of(mesh), "right-handed"));
  }
  SECTION("primitives with a gap") {
    mesh.primitives = {{"a", 0, 3}, {"b", 4, 2}};
    CHECK(contains(failure_of(mesh), "primitive 1 starts at vertex 4"));
  }
  SECTION("primitives that leave vertices over") {
    mesh.primitives = {{"a", 0, 3}};
    CHECK(contains(failure_of(mesh), "the primitives have 3 vertices in all, but the mesh has 6"));
  }
  SECTION("fewer weights than vertices") {
    mesh.weights.pop_back();
    CHECK(contains(failure_of(mesh), "5 skinning weights for 6 vertices"));
  }
}

TEST_CASE("one bone and a thousand bones are fine") {
  for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, max_bone_count}) {
    FileMesh mesh = split_quad();
    mesh.bones = bones(count);
    mesh.weights.assign(6, weights({{static_cast<std::uint16_t>(count - 1), 1.0f}}));
    std::vector<std::string> warnings;
    CHECK(weld(mesh, warnings, NOOK_ERROR_INVALID_ARGUMENT).bones.size() == count);
  }
}

TEST_CASE("a welded mesh whose map points nowhere is refused") {
  std::vector<std::string> warnings;
  SkinnedMesh mesh = weld(split_quad(), warnings, NOOK_ERROR_INVALID_ARGUMENT);
  mesh.file_to_welded[4] = 4;
  CHECK_THROWS_AS(validate(mesh), Failure);
}
