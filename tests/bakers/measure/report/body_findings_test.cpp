#include "bakers/measure/report/body_findings.h"

#include <algorithm>
#include <cmath>

#include "bakers/import/skinned_mesh.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::report;

namespace {

constexpr std::uint32_t columns = 41;  // of a strip of 4 m by 0.1 m, so that a place is about a column
constexpr std::uint32_t row_count = 2;

// A strip along x: the bones are called Spine, LeftHand and a leaf below the hand without a role of its own.
bake::SkinnedMesh strip() {
  bake::SkinnedMesh mesh;
  mesh.bones = {{"Spine", -1, {}}, {"LeftHand", 0, {}}, {"prop", 1, {}}};
  for (std::uint32_t row = 0; row < row_count; ++row)
    for (std::uint32_t c = 0; c < columns; ++c) {
      mesh.position.push_back({0.1f * float(c), 0.1f * float(row), 0});
      bake::SkinWeights weights;
      weights.bone[0] = c < 20 ? 0 : c < 30 ? 1 : 2;
      weights.weight[0] = 1;
      mesh.weights.push_back(weights);
    }
  for (std::uint32_t c = 0; c + 1 < columns; ++c) {
    mesh.triangle.push_back({c, c + 1, c + columns});
    mesh.triangle.push_back({c + 1, c + 1 + columns, c + columns});
  }
  return mesh;
}

// Truth 0.5 everywhere, four poses of two clips, and a model that is right.
MeasuredBody right_body(const bake::SkinnedMesh& mesh) {
  MeasuredBody body;
  body.poses.resize(4, bake::Pose(mesh.bones.size()));
  body.clips = {{"walk", 0, 2}, {"grab", 2, 2}};
  body.truth.vertex_count = mesh.vertex_count();
  // 32768 is nearly a half; its exact value is what the model takes.
  body.truth.value.assign(4 * mesh.vertex_count(), 32768);
  body.model.assign(4, std::vector<float>(mesh.vertex_count(), body.traced(0, 0)));
  return body;
}

}  // namespace

TEST_CASE("a model that is right has no error anywhere") {
  const bake::SkinnedMesh mesh = strip();
  const BodyFindings found = find_errors(mesh, right_body(mesh), 4);
  CHECK(found.all.rms() == 0);
  CHECK(found.bias == 0);
  CHECK(found.places.empty());
}

TEST_CASE("planted errors are found in their clip, pose, part, joint and place") {
  const bake::SkinnedMesh mesh = strip();
  MeasuredBody body = right_body(mesh);
  const std::uint32_t wrong = 35, little = 5;  // columns: on the prop in the hand, and on the spine
  body.model[3][wrong] += 0.2f;
  body.model[1][little] -= 0.05f;
  const BodyFindings found = find_errors(mesh, body, 4);
  const std::vector<float> area = bake::vertex_areas(mesh, mesh.position);
  const double large = 0.04 * double(area[wrong]), small = 0.0025 * double(area[little]);

  // Floats hold 0.5 + 0.2 to 3e-8, so that squares are right to 1e-6 of themselves.
  CHECK(found.all.square == Approx(large + small).epsilon(1e-6));
  CHECK(found.bias ==
        Approx((0.2 * double(area[wrong]) - 0.05 * double(area[little])) / found.all.weight).epsilon(1e-5));
  CHECK(found.vertex_rms[wrong] == Approx(0.1).epsilon(1e-5));  // one of four poses

  REQUIRE(found.clips.size() == 2);
  CHECK(found.clips[0].name == "grab");
  CHECK(found.clips[0].worst_pose == 3);
  CHECK(found.clips[1].worst_pose == 1);

  REQUIRE(found.parts.size() == 2);
  CHECK(found.parts[0].name == "hands and fingers");
  CHECK(found.parts[0].error.square == Approx(large).epsilon(1e-6));
  CHECK(found.parts[1].name == "trunk");
  CHECK(found.joints[0].name == "prop");

  REQUIRE(found.places.size() == 2);
  CHECK(found.places[0].joint == "prop");
  CHECK(found.places[0].worst_pose == 3);
  CHECK(found.places[0].share == Approx(large / (large + small)).epsilon(1e-6));
  CHECK(std::count(found.places[0].vertices.begin(), found.places[0].vertices.end(), wrong) == 1);
  CHECK(found.places[1].joint == "Spine");
  CHECK(find_errors(mesh, body, 1).places.size() == 1);
}

TEST_CASE("what no light reaches does not count") {
  const bake::SkinnedMesh mesh = strip();
  MeasuredBody body = right_body(mesh);
  for (std::size_t t = 0; t < 4; ++t) {
    body.truth.value[t * mesh.vertex_count() + 7] = 300;  // 0.0046, below the bound of 0.01
    body.model[t][7] = 0.9f;
  }
  const BodyFindings found = find_errors(mesh, body, 4);
  CHECK(found.all.square == 0);
  CHECK(found.vertex_rms[7] == 0);
}
