// Bent normals of a model against a body whose AO and bent normal have closed forms.
#include "bakers/measure/character/bent_study.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sdk/src/core/failure.h"
#include "tests/bakers/character/patch_and_sphere.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using nook::measure::BentStudy;
using nook::measure::GlossyMap;

namespace {

constexpr Vec3 centre{0.6f, 0, 1}, up{0, 0, 1};
constexpr float radius = 0.85f;  // below the height, so that the sphere is wholly above the horizon
constexpr int side = 40;
constexpr std::size_t patch_vertices = side * side;

SkinnedMesh body() {
  return patch_and_sphere(centre, radius, side);
}

// A model that says the closed forms of the patch, whatever its spheres are.
CharacterModel planted_model(const SkinnedMesh& mesh) {
  CharacterModel model;
  model.bone_names.push_back("root");
  model.spheres.push_back({{0, 0, -5}, 0.1f, 0, 1});
  KeyPoint point{{}, up, {}, up, {}, {1, 0, 0, 0}};
  model.key_points.push_back(point);
  model.influences = 1;
  const Vec3 occluded = occluded_by_sphere(centre, radius, up);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool on_patch = v < patch_vertices;
    model.influence.push_back(0);
    model.alpha.push_back(1e-9f);
    model.blend.push_back(1);
    model.bias.push_back(on_patch ? 1 - ao_under_sphere(centre, radius, up) : 0);
    model.occluded.push_back(on_patch ? OccludedEnds{occluded, occluded} : OccludedEnds{});
    model.file_to_welded.push_back(std::uint32_t(v));
  }
  return model;
}

double closed_form_degrees() {
  const Vec3 bent = normalised((2.0f / 3) * up - occluded_by_sphere(centre, radius, up));
  return std::acos(double(dot(bent, up))) * 180 / std::numbers::pi;
}

}  // namespace

TEST_CASE("a model with the true AO and bent normals is as good as its reference") {
  const SkinnedMesh mesh = body();
  const std::vector<Pose> poses{{Mat3x4{}}};
  const GlossyMap white{"white", Environment(8, 4, std::vector<float>(3 * 8 * 4, 1.0f))};
  BentStudy study;
  study.points = 500;
  study.rays = 1024;
  const auto rows = nook::measure::bent_rows(mesh, planted_model(mesh), poses,
                                             std::span<const GlossyMap>(&white, 1), study);
  REQUIRE(rows.size() == 6);  // three methods, by visibility and under the map
  const auto number = [&](std::size_t row, const char* key) { return rows[row][key].get<double>(); };
  CHECK(rows[0]["method"] == "normal");
  CHECK(rows[1]["method"] == "nook");
  CHECK(rows[2]["method"] == "reference");
  CHECK(closed_form_degrees() > 15);
  // 1,024 stratified rays leave about 0.3 / 32 in each component of a bent vector of half a unit, which is a
  // degree.
  CHECK(std::abs(number(0, "angle_median") - closed_form_degrees()) < 1.5);
  CHECK(number(1, "angle_median") < 1.5);
  CHECK(number(2, "angle_median") == 0);
  // The form of the specular occlusion has an error of its own, which both have.
  CHECK(std::abs(number(1, "specular_mse") - number(2, "specular_mse")) < 0.05 * number(2, "specular_mse"));
  CHECK(number(1, "specular_mse") < number(0, "specular_mse"));
  // A white map is uniform light.
  for (std::size_t row = 0; row < 3; ++row) {
    CHECK(rows[3 + row]["map"] == "white");
    CHECK(std::abs(number(3 + row, "specular_mse") - number(row, "specular_mse")) < 1e-4);
    CHECK(std::abs(number(3 + row, "lagarde_mse") - number(row, "lagarde_mse")) < 1e-4);
  }
}

TEST_CASE("the points of a fit have the pixels of the model and of the reference") {
  const SkinnedMesh mesh = body();
  BentStudy study;
  study.points = 200;
  study.rays = 512;
  const CharacterModel model = planted_model(mesh);
  const std::vector<Pose> poses{{Mat3x4{}}};
  const auto samples = nook::measure::bent_samples(mesh, model, poses, study);
  REQUIRE(samples.size() > study.points / 2);
  const float truth = ao_under_sphere(centre, radius, up);
  std::size_t dark = 0;
  for (const auto& sample : samples) {
    CHECK(dot(sample.network.normal, sample.network.to_viewer) > 0);
    if (std::abs(sample.network.ao - truth) > 1e-4f) continue;
    ++dark;
    // Noise of 512 rays, and the polyhedron covers 0.5 % too little.
    CHECK(std::abs(sample.reference.ao - truth) < 0.03f);
    CHECK(dot(sample.network.bent_normal, sample.reference.bent_normal) > 0.998f);
    for (const float visible : sample.visible) CHECK((visible >= 0 && visible <= 1));
  }
  CHECK(dark > samples.size() / 4);
}

TEST_CASE("a study of a model without bent normals names the command that adds them") {
  const SkinnedMesh mesh = body();
  CharacterModel model = planted_model(mesh);
  model.occluded.clear();
  const std::vector<Pose> poses{{Mat3x4{}}};
  try {
    nook::measure::bent_rows(mesh, model, poses, {}, {});
    FAIL("no failure");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_UNSUPPORTED);
    CHECK(std::string(failure.what()).find("nook bake bent") != std::string::npos);
  }
}
