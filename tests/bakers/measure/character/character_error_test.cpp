// Errors over all vertex-poses and over the visible ones, on a body with one half inside the other.
#include "bakers/measure/character/character_error.h"

#include <tbb/global_control.h>

#include <numeric>

#include "bakers/character/character_bake.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/character/surface_error.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::measure;

namespace {

// A closed tube inside another; the inner one has half the vertices and no ray leaves it.
SkinnedMesh nested_tubes() {
  SkinnedMesh mesh = bending_tube(12, 8);
  const SkinnedMesh inner = bending_tube(12, 8, 0.9f, 0.04f);
  const auto first = std::uint32_t(mesh.vertex_count());
  for (const Vec3 p : inner.position) mesh.position.push_back({p.x + 0.05f, p.y, p.z});
  mesh.weights.insert(mesh.weights.end(), inner.weights.begin(), inner.weights.end());
  for (const auto& t : inner.triangle) mesh.triangle.push_back({t[0] + first, t[1] + first, t[2] + first});
  for (std::uint32_t i = 0; i < inner.vertex_count(); ++i) mesh.file_to_welded.push_back(first + i);
  mesh.primitives = {{"tubes", 0, std::uint32_t(mesh.vertex_count())}};
  return mesh;
}

std::vector<Pose> small_bends(const SkinnedMesh& mesh) {
  std::vector<Pose> poses;
  for (const float angle : {0.0f, 0.2f, 0.4f, 0.6f}) {
    const JointRotation joint{1, {0, angle, 0}};
    poses.push_back(turn_joints(mesh, {&joint, 1}));
  }
  return poses;
}

struct Mean {
  double sum = 0;
  std::size_t count = 0;

  void add(double error) {
    sum += error * error;
    ++count;
  }
  double value() const { return sum / double(count); }
};

// A baseline with one value everywhere.
class Constant : public PoseRegression {
 public:
  explicit Constant(std::size_t vertices) : ao_(vertices, 0.75f) {}
  std::vector<float> predict(const Pose&) const override { return ao_; }
  std::size_t model_bytes() const override { return 4; }
  std::string description() const override { return "constant"; }

 private:
  std::vector<float> ao_;
};

constexpr std::uint32_t rays = 256;
constexpr std::uint64_t seed = 5;

}  // namespace

TEST_CASE("errors over visible vertex-poses leave out what ray tracing finds black") {
  const SkinnedMesh mesh = nested_tubes();
  const std::vector<Pose> poses = small_bends(mesh);
  BakeSettings settings;
  settings.spheres = 8;
  settings.key_points = 30;
  settings.rays = 64;
  settings.steps = 20;
  CharacterModel model = bake_character(mesh, poses, settings).model;
  // A bias on the black half, which no visible error may hold.
  for (std::size_t i = model.vertex_count() / 2; i < model.vertex_count(); ++i) model.bias[i] -= 0.5f;

  const CharacterEvaluation e = evaluate_character(mesh, model, poses, rays, seed);
  const AoTargets truth = trace_character_ao(mesh, poses, rays, seed);
  CHECK(e.truth.value == truth.value);
  Mean all, visible, visible_static;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    const std::vector<float> ao = predict_ao(model, poses[t]);
    for (std::size_t i = 0; i < ao.size(); ++i) {
      const double value = double(truth.row(t)[i]) / 65535;
      all.add(double(ao[i]) - value);
      if (value < 0.01) continue;
      visible.add(double(ao[i]) - value);
      visible_static.add(double(model.static_ao[i]) - value);
    }
  }
  // Sums in another order, and predictions of one pose at a time: single precision apart.
  const double relative = 1e-5;
  CHECK(visible.count < all.count);
  CHECK(e.visible_share ==
        Approx(0.5).margin(0.05));  // the inner half is black but for where the tubes cross
  CHECK(e.visible_share == double(visible.count) / double(all.count));
  CHECK(e.model.mse == Approx(all.value()).epsilon(relative));
  CHECK(e.model.mse_visible == Approx(visible.value()).epsilon(relative));
  CHECK(e.static_bake.mse_visible == Approx(visible_static.value()).epsilon(relative));
  CHECK(e.model.mse > 0.1);           // half of the vertices are wrong by 0.5
  CHECK(e.model.mse_visible < 0.05);  // and nobody sees it

  SECTION("no static bake is better than the oracle, over visible vertex-poses as well") {
    CHECK(e.oracle.mse_visible > 0);
    CHECK(e.oracle.mse_visible < e.static_bake.mse_visible);
    // The mean over visible poses is the best constant of a vertex, so that any other one is worse.
    Mean shifted;
    for (std::size_t i = 0; i < truth.vertex_count; ++i) {
      double sum = 0;
      std::size_t count = 0;
      for (std::size_t t = 0; t < poses.size(); ++t)
        if (truth.row(t)[i] >= 0.01 * 65535) sum += double(truth.row(t)[i]) / 65535, ++count;
      for (std::size_t t = 0; t < poses.size(); ++t)
        if (truth.row(t)[i] >= 0.01 * 65535)
          shifted.add(sum / double(count) + 0.01 - double(truth.row(t)[i]) / 65535);
    }
    CHECK(shifted.value() - e.oracle.mse_visible == Approx(1e-4).epsilon(1e-6));  // 0.01 squared
  }
  SECTION("the baselines' column is over the same vertex-poses") {
    const Constant baseline(mesh.vertex_count());
    const RegressionError error =
        measure_regression(baseline, poses, truth, vertex_areas(mesh, mesh.position));
    Mean constant;
    for (const std::uint16_t value : truth.value)
      if (value >= 0.01 * 65535) constant.add(0.75 - double(value) / 65535);
    CHECK(constant.count == visible.count);
    CHECK(error.mse_visible == Approx(constant.value()).epsilon(relative));
    CHECK(error.mse > error.mse_visible);  // the black half is far from 0.75
  }
}

TEST_CASE("errors between vertices measure interpolated AO, and need a visible surface") {
  SkinnedMesh mesh = nested_tubes();
  mesh.triangle.push_back({0, 0, 1});  // without an area
  const std::vector<Pose> poses = small_bends(mesh);
  BakeSettings settings;
  settings.spheres = 8;
  settings.key_points = 30;
  settings.rays = 64;
  settings.steps = 20;
  CharacterModel model = bake_character(mesh, poses, settings).model;
  // The same constant by both.
  std::fill(model.alpha.begin(), model.alpha.end(), 0.0f);
  std::fill(model.bias.begin(), model.bias.end(), 0.25f);
  std::fill(model.static_ao.begin(), model.static_ao.end(), 0.75f);
  const SurfaceErrors errors = measure_surface(mesh, model, poses, 3);
  CHECK(errors.model > 0.01);
  CHECK(errors.model == Approx(errors.static_bake).epsilon(1e-5));  // sums of floats
  CHECK(errors.exact_vertices < errors.model);
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  const auto half = area.begin() + std::ptrdiff_t(area.size() / 2);
  const double outer = double(std::accumulate(area.begin(), half, 0.0f)),
               inner = double(std::accumulate(half, area.end(), 0.0f));
  // The inner tube is hidden but for where it comes out at the bend.
  CHECK(errors.visible_share == Approx(outer / (outer + inner)).margin(0.05));
  {
    const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
    const SurfaceErrors same = measure_surface(mesh, model, poses, 3);
    CHECK(same.model == errors.model);
    CHECK(same.exact_vertices == errors.exact_vertices);
  }
  for (const int calls : {0, 3, 20}) {  // of about 36: a pose each, and 8 blocks of its points
    int left = calls;
    CHECK_THROWS_AS(
        measure_surface(mesh, model, poses, 3, [&](std::size_t, std::size_t) { return left-- > 0; }),
        Failure);
  }
  // All fronts face inwards.
  for (auto& t : mesh.triangle) std::swap(t[1], t[2]);
  const SurfaceErrors inside = measure_surface(mesh, model, {poses.data(), 1}, 3);
  CHECK(inside.visible_share == Approx(0).margin(0.05));
}
