// A whole bake on a small body: its error is smaller than the error of a static bake, it is reproducible, it
// can be cancelled, and quantisation adds little error.
#include "bakers/character/character_bake.h"

#include <tbb/global_control.h>

#include "bakers/character/block_descent.h"
#include "bakers/character/caster_weights.h"
#include "bakers/character/export_model.h"
#include "bakers/character/mini_batch_fit.h"
#include "bakers/measure/character/character_error.h"
#include "sdk/src/character/model_file.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/bakers/character/direct_objective.h"
#include "tests/bakers/character/patch_and_sphere.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;

namespace {

BakeSettings small_settings() {
  BakeSettings s;
  s.spheres = 16;
  s.key_points = 60;
  s.rays = 64;
  s.steps = 300;
  return s;
}

}  // namespace

TEST_CASE("a baked model follows poses that it has not seen") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> train = tube_poses(mesh, 150);
  const FitMethod method = GENERATE(FitMethod::nook, FitMethod::paper);
  BakeSettings settings = small_settings();
  settings.fit = method;
  if (method == FitMethod::paper) {
    settings.steps = 4;
    settings.kernel = {KernelForm::paper, 2.0f};
  }
  const BakeResult baked = bake_character(mesh, train, settings);
  CHECK(baked.report.mse_train < baked.report.mse_initial);
  std::vector<Pose> unseen;
  for (float angle : {0.4f, 0.9f, 1.4f, 1.9f}) {
    const JointRotation joint{1, {0, angle * 0.8f, angle * 0.6f}};
    unseen.push_back(turn_joints(mesh, {&joint, 1}));
  }
  const CharacterEvaluation e = evaluate_character(mesh, baked.model, unseen, 256, 5);
  INFO("mse " << e.model.mse << " static " << e.static_bake.mse << " oracle " << e.oracle.mse);
  CHECK(e.noise_floor_mse < 1e-4);               // 3.3e-5 is usual for 256 stratified rays
  CHECK(e.model.mse < 0.2 * e.static_bake.mse);  // real bodies have 0.05 to 0.09, docs/lab/character.md
  CHECK(e.model.mse < e.oracle.mse);

  // Quantisation raises the error only slightly.
  const CharacterEvaluation shipped = evaluate_character(mesh, quantise(baked.model), unseen, 256, 5);
  CHECK(shipped.model.mse < 1.05 * e.model.mse + 1e-5);
}

TEST_CASE("the same seed gives the same model on any number of threads") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  const std::vector<Pose> poses = tube_poses(mesh, 40);
  BakeSettings settings = small_settings();
  settings.steps = 60;
  std::vector<std::byte> one;
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    one = write_character_model(bake_character(mesh, poses, settings).model);
  }
  CHECK(one == write_character_model(bake_character(mesh, poses, settings).model));
  settings.seed = 2;
  CHECK(one != write_character_model(bake_character(mesh, poses, settings).model));
}

TEST_CASE("a learned gamma fits nearly as well as the best fixed one") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  const std::vector<Pose> poses = tube_poses(mesh, 80);
  BakeSettings settings = small_settings();
  double least = 1;
  for (const float gamma : {1.0f, 1.5f, 2.0f, 2.5f}) {
    settings.kernel.gamma = gamma;
    least = std::min(least, bake_character(mesh, poses, settings).report.mse_held_out);
  }
  settings.learn_gamma = true;
  const BakeResult learned = bake_character(mesh, poses, settings);
  INFO("gamma " << learned.model.kernel.gamma << " error " << learned.report.mse_held_out << " lowest "
                << least);
  // The choice comes from fits of 15 steps, a twentieth of the bake. With six seeds, the error was at
  // most 1.25 times the lowest one, and the error with the exponent 1 was 1.4 to 1.8 times the lowest.
  CHECK(learned.report.mse_held_out < 1.35 * least);
}

TEST_CASE("a known model is recovered from its own AO") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  BakeSettings settings = small_settings();
  settings.steps = 200;
  const std::vector<Pose> poses = tube_poses(mesh, 80);
  const CharacterModel planted = bake_character(mesh, poses, settings).model;
  TrainingSet set;
  set.poses = poses;
  set.targets.vertex_count = mesh.vertex_count();
  set.vertex_weight.assign(mesh.vertex_count(), 1.0f);
  for (const Pose& pose : poses)
    for (float ao : predict_ao(planted, pose)) set.targets.value.push_back(std::uint16_t(ao * 65535 + 0.5f));
  // Moved off its optimum, the fit must find the way back.
  FitState state = state_of_model(planted);
  for (std::size_t i = 0; i < state.parameters.size(); i += 3) state.parameters[i] += 0.01f;
  for (float& a : state.linear.alpha) a *= 0.8f;
  const double before = measure_fit(state, set, 0, poses.size(), set.vertex_weight).mse;
  MiniBatchSettings batch;
  batch.steps = 400;
  batch.rate = 0.3f;
  fit_mini_batches(state, set, batch);
  const double after = measure_fit(state, set, 0, poses.size(), set.vertex_weight).mse;
  CHECK(before > 1e-4);
  CHECK(after < 0.05 * before);
}

TEST_CASE("block descent never makes the cached objective worse") {
  const SkinnedMesh mesh = bending_tube(16, 10);
  const std::vector<Pose> poses = tube_poses(mesh, 40);
  BakeSettings settings = small_settings();
  settings.steps = 0;
  FitState state = state_of_model(bake_character(mesh, poses, settings).model);
  TrainingSet set;
  set.poses = poses;
  set.targets = trace_character_ao(mesh, poses, 32, 1);
  set.vertex_weight.assign(mesh.vertex_count(), 1.0f);
  const double before = evaluate_cached(state, set, cache_linear_layer(state, set), nullptr);
  const double after = descend_non_linear(state, set, {10, 8});
  CHECK(after < before);
  CHECK(std::abs(bake::test::evaluate_direct(state, set, nullptr) - after) < 1e-4 * after + 1e-7);
}

TEST_CASE("caster weights give the traced darkening of points outside the body") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 20);
  BakeSettings settings = small_settings();
  settings.steps = 0;
  const CharacterModel model = bake_character(mesh, poses, settings).model;
  // A surface facing the tube's side, 1 m away: the traced form factor of its silhouette.
  TriangleSoup soup{mesh.position, mesh.triangle};
  const Vec3 position{0.5f, 0, -1}, normal{0, 0, 1};
  AoSettings rays;
  rays.rays = 16384;
  const float traced = 1 - trace_ao(soup, {{&position, 1}, {&normal, 1}}, rays)[0];
  float depth = 0;
  for (const ProxySphere& s : model.spheres) {
    const Vec3 d = (s.centre - position) * (1 / s.radius);
    depth += s.caster_weight * form_factor_fast(dot(d, normal), dot(d, d));
  }
  const float fitted = 1 - std::exp(-solid_depth(depth));
  CHECK(traced > 0.03f);
  CHECK(std::abs(fitted - traced) < 0.15f * traced);  // real bodies have up to 0.24, docs/lab/character.md
}

TEST_CASE("a ball of fitted casters darkens as its closed form, from contact to far away") {
  // A ball of 0.2 m, by spheres as the fit of self-shadow leaves them: small, and scattered in its inside.
  constexpr float radius = 0.2f;
  const SkinnedMesh mesh = patch_and_sphere({0, 0, 0}, radius);
  CharacterModel model;
  model.bounding_radius = radius;
  for (int i = 0; i < 60; ++i) {
    // Even directions by the golden angle, at three depths.
    const float z = 1 - (2 * float(i) + 1) / 60, turn = 2.3999632f * float(i), across = std::sqrt(1 - z * z),
                depth = radius * (0.45f + 0.2f * float(i % 3));
    model.spheres.push_back({depth * Vec3{across * std::cos(turn), across * std::sin(turn), z}, 0.02f, 0, 1});
  }
  const std::vector<Pose> rest{Pose(1)};
  fit_caster_weights(model, mesh, rest, {});
  const auto fitted = [&](Vec3 point, Vec3 normal) {
    float sum = 0;
    for (const ProxySphere& s : model.spheres) {
      const Vec3 d = (s.centre - point) * (1 / s.radius);
      sum += s.caster_weight * form_factor_fast(dot(d, normal), dot(d, d));
    }
    return 1 - std::exp(-solid_depth(sum));
  };
  const auto exact = [&](Vec3 point, Vec3 normal) {
    const Vec3 d = -point * (1 / radius);
    return form_factor_exact(dot(d, normal), dot(d, d));
  };
  SECTION("a plane beneath it") {
    // From a hand's breadth on; the small spheres show one by one where the plane is nearer. A ball is
    // thicker than limbs, for which solid_depth stands, so that its fit is brighter near it and darker far
    // away.
    for (const float gap : {0.1f, 0.2f, 0.4f, 0.8f, 1.6f})
      for (const float aside : {0.0f, 0.1f, 0.3f}) {
        const Vec3 point{aside, -radius - gap, 0}, normal{0, 1, 0};
        INFO("gap " << gap << " aside " << aside << " fitted " << fitted(point, normal) << " exact "
                    << exact(point, normal));
        CHECK(std::abs(fitted(point, normal) / exact(point, normal) - 1) < 0.2f);
      }
  }
  SECTION("another ball that touches it") {
    double mean = 0, truth = 0;
    for (int i = 0; i < 400; ++i) {
      const float z = 1 - (2 * float(i) + 1) / 400, turn = 2.3999632f * float(i),
                  across = std::sqrt(1 - z * z);
      const Vec3 normal{across * std::cos(turn), across * std::sin(turn), z};
      const Vec3 point = Vec3{0, 2 * radius, 0} + radius * normal;
      mean += double(fitted(point, normal));
      truth += double(exact(point, normal));
    }
    INFO("fitted " << mean / 400 << " exact " << truth / 400);
    CHECK(std::abs(mean / truth - 1) < 0.07);  // docs/lab/character.md has bodies in contact
  }
}

TEST_CASE("bakes refuse invalid settings and stop when they are cancelled") {
  const SkinnedMesh mesh = bending_tube(8, 8);
  BakeSettings settings = small_settings();
  CHECK_THROWS(bake_character(mesh, {}, settings));
  const std::vector<Pose> short_pose{Pose(1)};
  CHECK_THROWS(bake_character(mesh, short_pose, settings));
  std::vector<Pose> poses = tube_poses(mesh, 4);
  poses[2][1].m[5] = NAN;
  CHECK_THROWS(bake_character(mesh, poses, settings));
  poses = tube_poses(mesh, 20);
  CHECK_THROWS(bake_character(mesh, poses, settings, [](BakeStage stage, std::size_t, std::size_t) {
    return stage != BakeStage::fit;
  }));
  settings.kernel.gamma = 0.5f;
  CHECK_THROWS(bake_character(mesh, poses, settings));
}
