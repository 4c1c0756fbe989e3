// The shapes for debug drawing are those that an update evaluates.
#include <algorithm>
#include <cmath>

#include "bakers/character/levels.h"
#include "sdk/src/character/scene_readings.h"
#include "tests/catch.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// Sums of a few products of numbers below 2 m, which the kernels add up in another order.
constexpr float rounding_m = 2e-6f;

float distance(const float (&a)[3], float x, float y, float z) {
  return length(Vec3{a[0], a[1], a[2]} - Vec3{x, y, z});
}

std::vector<std::vector<Mat3x4>> turned_poses(const CharacterModel& model) {
  std::vector<std::vector<Mat3x4>> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(stiff_pose(model, {}, 0.1f * float(i)));
  return poses;
}

std::vector<nook_instance_id> links_of(const Scene& scene, nook_instance_id id) {
  const Instance& instance = instance_of(scene, id);
  std::vector<nook_instance_id> casters(link_count(scene, instance));
  read_links(scene, instance, casters.data());
  return casters;
}

// Compares what is read with the lanes of the kernels.
void check_shapes(const Instance& instance) {
  const std::uint32_t level = instance.plan.level;
  const InstanceArrays& arrays = instance.arrays();
  const SphereLanes& s = level == 0 ? arrays.spheres : arrays.coarse_spheres[level - 1];
  std::vector<nook_scene_sphere> spheres(sphere_count(instance));
  read_spheres(instance, spheres.data());
  REQUIRE(spheres.size() == s.count);
  for (std::uint32_t i = 0; i < s.count; ++i) {
    CHECK(distance(spheres[i].centre_ws, s.x[i], s.y[i], s.z[i]) < rounding_m);
    CHECK(std::abs(spheres[i].radius * s.inverse_radius[i] - 1) < 1e-5f);
  }
  const PointLanes& p = arrays.points;
  std::vector<nook_scene_key_point> points(key_point_count(instance));
  read_key_points(instance, points.data());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    CHECK(distance(points[i].position_ws, p.x[i], p.y[i], p.z[i]) < rounding_m);
    // The kernels take reciprocal square roots with a relative error of 1e-3 at most.
    CHECK(distance(points[i].normal_ws, p.nx[i], p.ny[i], p.nz[i]) < 2e-3f);
    // Only what casters are felt by is posed.
    if (instance.result.has_added)
      CHECK(distance(points[i].surface_position_ws, p.surface_x[i], p.surface_y[i], p.surface_z[i]) <
            rounding_m);
    CHECK(points[i].shadow == p.shadow[points[i].index]);
    CHECK(points[i].added == p.added[points[i].index]);
  }
}

}  // namespace

TEST_CASE("shapes for debug drawing equal the shapes of the kernels, also in scaled poses") {
  Scene scene = make_scene();
  const auto model = load(sample_model(3));
  const nook_instance_id id = place(scene, model, {0.3f, 0.1f, -0.2f}, 0.7f, 1.3f);
  const Plane plane{{0, 1, 0}, -1};
  set_ground(scene, id, &plane);
  update(scene);
  REQUIRE(instance_of(scene, id).result.has_added);
  check_shapes(instance_of(scene, id));
}

TEST_CASE("shapes for debug drawing follow the level of detail") {
  CharacterModel data = sample_model(41, {6, 60, 120, 400, 40, 4});
  for (const CharacterLevel& level : nook::bake::make_levels(data, turned_poses(data)))
    data.levels.push_back(level);
  REQUIRE(!data.levels.empty());
  SceneSettings settings;
  settings.lod_error = 1;
  settings.lod_distance = 1;
  Scene scene = make_scene(settings);
  scene.has_camera = true;
  scene.camera = {0, 0, 100};
  const nook_instance_id id = place(scene, load(data), {0.3f, 0.1f, -0.2f}, 0.7f);
  update(scene);
  const Instance& instance = instance_of(scene, id);
  REQUIRE(instance.plan.level == data.levels.size());
  check_shapes(instance);
  const nook_scene_instance_info info = describe_instance(scene, instance);
  CHECK(info.level == data.levels.size());
  CHECK(info.level_error == data.levels.back().error_rms);
  CHECK(info.sphere_count == data.levels.back().spheres.size());
  CHECK(info.key_point_count == data.levels.back().evaluated.size());
}

TEST_CASE("key points have no values before the first update on the CPU") {
  Scene scene = make_scene();
  const nook_instance_id id = place(scene, load(sample_model()), {});
  const Instance& instance = instance_of(scene, id);
  std::vector<nook_scene_key_point> points(key_point_count(instance));
  read_key_points(instance, points.data());
  for (const nook_scene_key_point& point : points) {
    CHECK(point.shadow == -1);
    CHECK(point.added == -1);
  }
  CHECK(describe_instance(scene, instance).updated == 0);
}

TEST_CASE("links are from the last update, without instances that have gone") {
  Scene scene = make_scene();
  const auto model = load(sample_model());
  const nook_instance_id a = place(scene, model, {}), b = place(scene, model, {1, 0, 0}),
                         c = place(scene, model, {-1, 0, 0});
  link(scene, a, b);
  CHECK(links_of(scene, a).empty());  // before the update
  link_nearest(scene, 2, 1.5f);
  update(scene);
  CHECK(links_of(scene, a) == std::vector<nook_instance_id>{b, c});
  CHECK(links_of(scene, b) == std::vector<nook_instance_id>{a});
  CHECK(describe_instance(scene, instance_of(scene, a)).link_count == 2);
  remove_instance(scene, c);
  CHECK(links_of(scene, a) == std::vector<nook_instance_id>{b});
  const nook_instance_id d = place(scene, model, {0, 0, 1});  // takes the slot of c
  CHECK(links_of(scene, a) == std::vector<nook_instance_id>{b});
  update(scene);
  CHECK(links_of(scene, a) == std::vector<nook_instance_id>{b, d});
}
