#include "bakers/world/fit_casters.h"

#include <tbb/task_arena.h>

#include <cmath>

#include "bakers/character/pose_sets.h"
#include "bakers/import/skinned_mesh.h"
#include "bakers/measure/world/silhouette.h"
#include "bakers/measure/world/world_report.h"
#include "bakers/world/body_metres.h"
#include "bakers/world/dual.h"
#include "bakers/world/initial_casters.h"
#include "bakers/world/posed_casters.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/character/bending_tube.h"
#include "tests/bakers/raytrace/sphere_soup.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;
using namespace nook::bake;

namespace {

WorldCasterSettings small_settings() {
  WorldCasterSettings s;
  s.casters = 4;
  s.poses = 12;
  s.steps = 8;
  return s;
}

// Distance from a point to the axis of a capsule, less its radius there.
float outside(Vec3 p, const Capsule& c) {
  const Vec3 e = c.b - c.a;
  const float t = std::clamp(dot(p - c.a, e) / std::max(dot(e, e), 1e-12f), 0.0f, 1.0f);
  return length(p - c.a - t * e) - (c.radius_a + t * (c.radius_b - c.radius_a));
}

}  // namespace

TEST_CASE("world casters: derivatives equal finite differences") {
  test::Numbers numbers(4);
  for (int i = 0; i < 200; ++i) {
    const Vec3 a = numbers.place(0.5f) + Vec3{0, 0, 1}, b = a + numbers.place(0.5f);
    const float values[8] = {
        a.x, a.y, a.z, b.x, b.y, b.z, numbers.between(0.05f, 0.2f), numbers.between(0.05f, 0.2f)};
    Dual lane[8];
    for (int k = 0; k < 8; ++k) lane[k] = Dual::parameter(values[k], k);
    const Dual f =
        world::coverage<Dual>({lane[0], lane[1], lane[2], lane[3], lane[4], lane[5], lane[6], lane[7]},
                              Dual(0.0f), Dual(0.0f), Dual(1.0f));
    for (std::size_t k = 0; k < 8; ++k) {
      const auto at = [&](double change) {
        double v[8];
        for (std::size_t j = 0; j < 8; ++j) v[j] = double(values[j]) + (j == k ? change : 0);
        return world::coverage<double>({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]}, 0, 0, 1);
      };
      const double h = 1e-5, slope = (at(h) - at(-h)) / (2 * h);
      // Floats have seven digits, and differences of near directions lose two of them; shares change by up to
      // 10 a metre.
      CHECK(std::abs(double(f.slope[k]) - slope) < 0.02 * (std::abs(slope) + 1));
    }
  }
}

TEST_CASE("world casters: derivatives of a part of a cone equal finite differences") {
  test::Numbers numbers(9);
  const double slope = 0.05;
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    // Capsules near the axis, of a fifth of a part to three parts.
    const Vec3 a = numbers.place(0.1f) + Vec3{0, 0, 1}, b = a + numbers.place(0.2f);
    const float values[8] = {
        a.x, a.y, a.z, b.x, b.y, b.z, numbers.between(0.01f, 0.15f), numbers.between(0.01f, 0.15f)};
    Dual lane[8];
    for (int k = 0; k < 8; ++k) lane[k] = Dual::parameter(values[k], k);
    const Dual f =
        world::part_coverage<Dual>({lane[0], lane[1], lane[2], lane[3], lane[4], lane[5], lane[6], lane[7]},
                                   Dual(0.0f), Dual(0.0f), Dual(1.0f), Dual(float(slope)));
    for (std::size_t k = 0; k < 8; ++k) {
      const auto at = [&](double change) {
        double v[8];
        for (std::size_t j = 0; j < 8; ++j) v[j] = double(values[j]) + (j == k ? change : 0);
        return world::part_coverage<double>({v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]}, 0, 0, 1, slope);
      };
      const double h = 1e-5, left = (at(0) - at(-h)) / h, right = (at(h) - at(0)) / h;
      // The share has a kink where an edge meets the part's border.
      if (std::abs(left - right) > 0.02 * (std::abs(left) + 1)) continue;
      ++compared;
      // Shares change by up to 2 / pi / slope, 13 a metre, and floats have seven digits.
      CHECK(std::abs(double(f.slope[k]) - 0.5 * (left + right)) < 0.02 * (std::abs(left) + 1));
    }
  }
  CHECK(compared > 2800);
}

TEST_CASE("world casters: initial capsules lie along the body and cover it") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<float> area = vertex_areas(mesh, mesh.position);
  for (const std::size_t count : {2u, 4u, 8u}) {
    const std::vector<WorldCaster> casters = initial_casters(mesh, area, count);
    REQUIRE(casters.size() == count);
    for (const Vec3 p : mesh.position) {
      float nearest = INFINITY;
      for (const WorldCaster& caster : casters) nearest = std::min(nearest, outside(p, caster.capsule));
      // A vertex of the tube, of radius 0.1 m, is within half a radius of a capsule.
      CHECK(nearest < 0.05f);
    }
  }
  CHECK(bone_capsules(mesh, area).size() == 2);
  // A capsule of a low-poly body stands for 12 vertices or more.
  CHECK(initial_casters(mesh, area, 64).size() <= mesh.position.size() / 12);
}

TEST_CASE("world casters: a fit of a tube is close to ray tracing on poses that it has not seen") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 24);
  std::vector<Pose> seen, unseen;
  for (std::size_t i = 0; i < poses.size(); ++i) (i % 2 ? unseen : seen).push_back(poses[i]);
  WorldCasterReport report;
  const std::vector<WorldCaster> casters = fit_world_casters(mesh, seen, small_settings(), &report);
  REQUIRE(casters.size() == 4);
  CHECK(report.error_fitted < 0.5 * report.error_initial);
  for (const WorldCaster& caster : casters) {
    CHECK(caster.bone < 2);
    // The tube's radius is 0.1 m.
    CHECK((caster.capsule.radius_a > 0.02f && caster.capsule.radius_a < 0.2f));
    CHECK((caster.capsule.radius_b > 0.02f && caster.capsule.radius_b < 0.2f));
  }
  measure::WorldStudy study;
  study.casters = casters;
  study.points = 300;
  study.rays = 256;
  CharacterModel model;
  model.spheres.push_back({{0.5f, 0, 0}, 0.1f, 0, 1});
  const auto rows = measure::world_rows(mesh, model, unseen, study, {});
  for (const auto& row : rows) {
    if (row["method"] != "nook") continue;
    INFO(row.dump());
    // A tube is a simple body. Its shadow has edges that the parts of a cone blur.
    CHECK(row["over_none"].get<double>() < (row["surface"] == "cone" ? 0.1 : 0.04));
  }
}

TEST_CASE("world casters: the outline of a tube's shadow is closed and round") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 18);
  std::vector<Pose> seen, unseen;
  for (std::size_t i = 0; i < poses.size(); ++i) (i % 6 ? seen : unseen).push_back(poses[i]);
  measure::WorldStudy study;
  study.casters = fit_world_casters(mesh, seen, small_settings());
  for (const auto& row : measure::silhouette_rows(mesh, CharacterModel(), unseen, study, {})) {
    if (row["method"] != "nook") continue;
    INFO(row.dump());
    // The tube is 0.2 m thick and its shadow about 0.25 m^2 with 2.5 m of edge: an edge that is off by 5 mm
    // takes 0.05. Its flat ends have round caps.
    CHECK(row["iou"].get<double>() > 0.9);
    CHECK(row["iou_low"].get<double>() > 0.85);
  }
}

namespace {

// A ball of one bone.
SkinnedMesh ball(Vec3 centre, float radius) {
  const TriangleSoup soup = sphere_soup(centre, radius, 48);
  SkinnedMesh mesh;
  mesh.bones.push_back({"ball", -1, Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}});
  mesh.position = soup.position;
  mesh.triangle = soup.triangle;
  mesh.weights.resize(mesh.position.size());
  for (auto& weights : mesh.weights) weights.weight[0] = 1;
  return mesh;
}

}  // namespace

TEST_CASE("world silhouettes: a ball and its sphere have one outline, a sphere of half the area half of it") {
  const Vec3 centre{0.1f, 0.6f, -0.2f};
  const SkinnedMesh mesh = ball(centre, 0.3f);
  const std::vector<Pose> rest = turned_poses(1, 0);
  const auto iou_of = [&](float radius) {
    measure::WorldStudy study;
    study.casters.emplace_back();
    study.casters[0].capsule = {centre, centre, radius, radius};
    for (const auto& row : measure::silhouette_rows(mesh, CharacterModel(), rest, study, {}))
      if (row["method"] == "nook") return row["iou"].get<double>();
    return -1.0;
  };
  // The shadow's edge passes 200 of its 4,000 cells, whose middles fall on either side by the truth's rays.
  CHECK(iou_of(0.3f) > 0.97);
  // Both shadows have one middle, so that the ratio of areas counts.
  CHECK(std::abs(iou_of(0.3f * std::sqrt(0.5f)) - 0.5) < 0.02);
}

namespace {

// A table of blocks with twelve triangles each, as modellers make them.
SkinnedMesh block_table() {
  SkinnedMesh mesh;
  mesh.bones.push_back({"table", -1, Mat3x4{{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}});
  const auto block = [&](Vec3 low, Vec3 high) {
    const auto first = std::uint32_t(mesh.position.size());
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      mesh.position.push_back(
          {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
      mesh.weights.emplace_back();
      mesh.weights.back().weight[0] = 1;
    }
    constexpr std::uint32_t faces[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                           {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (const auto& f : faces) {
      mesh.triangle.push_back({first + f[0], first + f[1], first + f[2]});
      mesh.triangle.push_back({first + f[0], first + f[2], first + f[3]});
    }
  };
  block({-0.8f, 0.71f, -0.45f}, {0.8f, 0.75f, 0.45f});
  for (const float x : {-0.765f, 0.765f})
    for (const float z : {-0.415f, 0.415f})
      block({x - 0.035f, 0, z - 0.035f}, {x + 0.035f, 0.71f, z + 0.035f});
  return mesh;
}

}  // namespace

TEST_CASE("world casters: a table of a few large triangles darkens the floor near ray tracing") {
  const SkinnedMesh mesh = block_table();
  WorldCasterSettings settings;
  settings.poses = 12;
  settings.steps = 8;
  settings.rays = 128;
  settings.casters = 24;
  measure::WorldStudy study;
  study.casters = fit_world_casters(mesh, turned_poses(12, 0), settings);
  REQUIRE(study.casters.size() == 24);
  study.points = 300;
  study.rays = 256;
  CharacterModel model;
  model.spheres.push_back({{0.5f, 0, 0}, 0.1f, 0, 1});
  for (const auto& row : measure::world_rows(mesh, model, turned_poses(6, 0.5f), study, {})) {
    if (row["method"] != "nook") continue;
    INFO(row.dump());
    // Floor and ring are below the plate, which 24 capsules fill; seen from a wall they are thicker than it.
    const std::string surface = row["surface"];
    const bool aside = surface == "wall" || surface == "neighbour";
    CHECK(row["over_none"].get<double>() < (aside ? 0.2 : surface == "cone" ? 0.15 : 0.05));
  }
}

TEST_CASE("world casters: a body in centimetres gets the casters of the body in metres") {
  const SkinnedMesh mesh = mesh_in_metres(bending_tube(), 2);
  const std::vector<Pose> poses = poses_in_metres(tube_poses(bending_tube(), 8), 2);
  REQUIRE(scale_to_metres(mesh) == 1);
  WorldCasterSettings settings = small_settings();
  settings.steps = 3;
  const std::vector<WorldCaster> one = fit_world_casters(mesh, poses, settings);
  const std::vector<WorldCaster> large =
      fit_world_casters(mesh_in_metres(mesh, 64), poses_in_metres(poses, 64), settings);
  REQUIRE(large.size() == one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Capsule &c = one[i].capsule, &d = large[i].capsule;
    // A power of two changes no digit.
    CHECK((d.a == 64 * c.a && d.b == 64 * c.b));
    CHECK((d.radius_a == 64 * c.radius_a && d.radius_b == 64 * c.radius_b));
    CHECK(large[i].ao_scale == one[i].ao_scale);
  }
}

TEST_CASE("world casters: the same seed gives the same casters on any number of threads") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 8);
  WorldCasterSettings settings = small_settings();
  settings.steps = 3;
  const auto on = [&](int threads) {
    std::vector<WorldCaster> casters;
    tbb::task_arena(threads).execute([&] { casters = fit_world_casters(mesh, poses, settings); });
    return casters;
  };
  const std::vector<WorldCaster> one = on(1), two = on(2);
  REQUIRE(one.size() == two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK((one[i].capsule.a == two[i].capsule.a && one[i].capsule.b == two[i].capsule.b));
    CHECK(one[i].capsule.radius_a == two[i].capsule.radius_a);
    CHECK(one[i].ao_scale == two[i].ao_scale);
  }
}

TEST_CASE("world casters: a fit can be cancelled at every step") {
  const SkinnedMesh mesh = bending_tube();
  const std::vector<Pose> poses = tube_poses(mesh, 4);
  WorldCasterSettings settings = small_settings();
  settings.steps = 2;
  std::size_t calls = 0;
  fit_world_casters(mesh, poses, settings, nullptr, [&](std::size_t done, std::size_t total) {
    CHECK(done < total);
    ++calls;
    return true;
  });
  CHECK(calls >= 5);
  for (std::size_t stop = 0; stop < calls; ++stop) {
    std::size_t call = 0;
    CHECK_THROWS_AS(fit_world_casters(mesh, poses, settings, nullptr,
                                      [&](std::size_t, std::size_t) { return call++ != stop; }),
                    Failure);
  }
}

TEST_CASE("world light: open shares by channel are AO under even light, and a sun becomes a cone") {
  const SkinnedMesh mesh = bending_tube();
  CharacterModel model;
  for (const WorldCaster& caster : initial_casters(mesh, vertex_areas(mesh, mesh.position), 8))
    model.world_casters.push_back(caster);
  constexpr std::uint32_t columns = 64, rows_of_map = 32;
  const std::vector<float> even(3 * columns * rows_of_map, 1.0f);
  std::vector<float> sun = even;
  std::fill_n(sun.begin() + 3 * (8 * columns + 20), 3, 2000.0f);
  const measure::NamedMap maps[] = {{"even", Environment(columns, rows_of_map, even)},
                                    {"sun", Environment(columns, rows_of_map, sun)}};
  measure::WorldStudy study;
  study.points = 200;
  study.rays = 128;
  for (const auto& row : measure::world_light_rows(mesh, model, tube_poses(mesh, 2), maps, study, {})) {
    INFO(row.dump());
    const std::string name = row["map"], method = row["method"];
    CHECK(row["sun"].get<bool>() == (name == "sun"));
    const double ratio = row["over_ao_x_probe"], soft = row["over_ao_x_probe_soft"];
    // The wall is darkened little, beside the noise of so few paths.
    if (row["surface"] != "floor") continue;
    // A shadow takes several times what is left of the error of casters that were not fitted.
    if (method == "none") CHECK(ratio > 2);
    if (method != "per_lobe") continue;
    // Both are the same number under even light.
    if (name == "even") CHECK(std::abs(soft - 1) < 0.02);
  }
}
