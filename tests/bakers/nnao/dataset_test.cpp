#include "bakers/nnao/dataset.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "bakers/nnao/cameras.h"
#include "bakers/nnao/host_normals.h"
#include "bakers/nnao/level_set.h"
#include "bakers/raytrace/ambient_occlusion.h"
#include "sdk/src/core/failure.h"
#include "tests/bakers/nnao/small_dataset.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake::nnao;

namespace {

bool same(const std::vector<DataPoint>& a, const std::vector<DataPoint>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].view != b[i].view || a[i].x != b[i].x || a[i].y != b[i].y || a[i].radius != b[i].radius ||
        a[i].ao != b[i].ao || !(a[i].open_direction == b[i].open_direction) || !(a[i].normal == b[i].normal))
      return false;
  return true;
}

}  // namespace

TEST_CASE("a training set is the same on one thread and on four, and another for another seed") {
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DatasetSettings settings = test::small_settings();
    settings.host_normal_share = 0.3f;
    return make_dataset(settings);
  };
  const Dataset one = with_threads(1), four = with_threads(4);
  REQUIRE(!one.training.empty());
  REQUIRE(!one.validation.empty());
  CHECK(same(one.training, four.training));
  CHECK(same(one.validation, four.validation));
  for (std::size_t v = 0; v < one.views.size(); ++v) REQUIRE(one.views[v].depth == four.views[v].depth);
  CHECK(!same(one.training, test::small_dataset(2).training));
}

TEST_CASE("training and validation share no scene, and every point is sound") {
  const Dataset data = test::small_dataset();
  std::set<std::uint32_t> training, validation;
  for (const DataPoint& point : data.training) training.insert(point.view % (2 * family_count));
  for (const DataPoint& point : data.validation) validation.insert(point.view % (2 * family_count));
  for (const std::uint32_t scene : training) CHECK(validation.count(scene) == 0);
  CHECK(training.size() == family_count);
  CHECK(validation.size() == family_count);
  bool sound = true;
  double low = 0, high = 0;
  for (const DataPoint& point : data.training) {
    const TracedView& view = data.views[point.view];
    const std::size_t at = std::size_t(point.y) * view.camera.width + point.x;
    const Vec3 position = nook::nnao::view_position(view.camera.rays, float(point.x) + 0.5f,
                                                    float(point.y) + 0.5f, view.depth[at]);
    sound = sound && std::isfinite(view.depth[at]) && point.ao >= 0 && point.ao <= 1;
    sound = sound && std::abs(length(point.normal) - 1) < 1e-4f;
    // Facing the viewer, but for the rounding of a surface seen edge-on.
    sound = sound && dot(point.normal, normalised(position)) < 1e-3f;
    const float radius_px =
        point.radius * std::abs(nook::nnao::pixel_scale(view.camera.rays, view.depth[at]).y);
    sound =
        sound && radius_px > 0.999f * Dataset::min_radius_px && radius_px < 1.001f * Dataset::max_radius_px;
    // The mean of unit vectors around the normal.
    sound = sound && (point.ao > 0) == (length(point.open_direction) > 0) &&
            length(point.open_direction) < 1.0001f && dot(point.open_direction, point.normal) > -1e-4f;
    low += point.ao < 0.3f;
    high += point.ao > 0.9f;
  }
  CHECK(sound);
  // Something to learn: dark points and open ones. Compilers draw the random scenes in different orders.
  CHECK(low > 0.005 * double(data.training.size()));
  CHECK(high > 0.1 * double(data.training.size()));
}

TEST_CASE("every family gives a scene with cameras that see surfaces, and has a name") {
  std::set<std::string> names;
  for (std::uint32_t index = 0; index < 2 * family_count; ++index) {
    INFO(family_name(index) << ", scene " << index);
    names.insert(family_name(index));
    const TrainingScene scene = make_scene(3, index);
    bool finite = true;
    for (const Vec3 p : scene.soup.position) finite = finite && std::isfinite(p.x + p.y + p.z);
    CHECK(finite);
    CHECK(scene.soup.triangle.size() > 1000);
    CHECK(scene.soup.triangle.size() < 1000000);
    const bake::RayScene rays(scene.soup);
    bake::Random random(index);
    const Camera camera = place_training_camera(rays, scene, random, 96, 54);
    const TracedView view = trace_view(rays, camera);
    const auto seen = std::ranges::count_if(view.depth, [](float depth) { return std::isfinite(depth); });
    CHECK(double(seen) > 0.3 * double(view.depth.size()));
    // All shapes of screens have about as many pixels.
    CHECK(std::abs(double(view.depth.size()) / (96 * 54) - 1) < 0.05);
  }
  CHECK(names.size() == family_count);
}

TEST_CASE("a scene is the same for its seed, and its scale moves its cameras with it") {
  const TrainingScene one = make_scene(5, 30), again = make_scene(5, 30);
  CHECK(one.soup.position == again.soup.position);
  CHECK(one.soup.triangle == again.soup.triangle);
  TrainingScene large = one;
  scale_scene(large, 4);
  CHECK(large.size == 4 * one.size);
  CHECK(large.soup.position[7] == 4.0f * one.soup.position[7]);
  CHECK(large.cameras.high == 4.0f * one.cameras.high);
  CHECK(large.subject.low == 4.0f * one.subject.low);
}

TEST_CASE("guests stand on the surfaces of their host") {
  bake::Random random(11);
  TrainingScene host;
  add_floor(host.soup, 5);
  host.cameras = host.subject = {{-1, 0, -1}, {1, 2, 1}};
  const TrainingScene guest = make_stacks(random);
  add_guests(host, guest, random);
  REQUIRE(host.soup.position.size() > 100);
  float low = 1, high = 0;
  for (std::size_t i = 4; i < host.soup.position.size(); ++i) {
    low = std::min(low, host.soup.position[i].y);
    high = std::max(high, host.soup.position[i].y);
  }
  CHECK(std::abs(low) < 1e-4f);
  CHECK(high > 0.01f);
}

TEST_CASE("the mean open direction follows the closed forms") {
  // An endless floor, and a wall at x = 0 as high as it is wide, which hides one half of the hemisphere of a
  // point at its foot.
  bake::TriangleSoup soup;
  add_floor(soup, 1e4f);
  const std::vector<Vec3> position(1, Vec3{0.001f, 0, 0}), normal(1, Vec3{0, 1, 0});
  bake::AoSettings settings;
  settings.rays = 4096;
  settings.origin_offset = 1e-4f;
  const bake::Openness plane = trace_openness(bake::RayScene(soup), {position, normal}, settings);
  // The mean of cosine-weighted directions is 2/3 of the normal.
  CHECK(plane.ao[0] == 1);
  CHECK(length(plane.direction[0] - Vec3{0, 2.0f / 3, 0}) < 0.005f);

  add_block(soup, {-1, 0, -1e4f}, {0, 1e4f, 1e4f});
  const bake::Openness corner = trace_openness(bake::RayScene(soup), {position, normal}, settings);
  CHECK(std::abs(corner.ao[0] - 0.5f) < 0.005f);
  // Of the open half, the mean across is 2/3 times the mean 2 / pi of a half circle's cosine.
  CHECK(length(corner.direction[0] - Vec3{4 / (3 * std::numbers::pi_v<float>), 2.0f / 3, 0}) < 0.01f);

  // Inside a closed box no ray is open.
  bake::TriangleSoup box;
  add_block(box, {-1, -1, -1}, {1, 1, 1});
  const bake::Openness closed = trace_openness(bake::RayScene(box), {position, normal}, settings);
  CHECK(closed.ao[0] == 0);
  CHECK(closed.direction[0] == Vec3{});
}

TEST_CASE("host normals tilt by 25 degrees at most, and change nothing but the normals") {
  DatasetSettings settings = test::small_settings();
  const Dataset plain = make_dataset(settings);
  settings.host_normal_share = 0.5f;
  const Dataset tilted = make_dataset(settings);
  REQUIRE(plain.training.size() == tilted.training.size());
  std::set<std::uint32_t> views;
  bool sound = true, same = true;
  for (std::size_t i = 0; i < plain.training.size(); ++i) {
    const DataPoint &a = plain.training[i], &b = tilted.training[i];
    same = same && a.ao == b.ao && a.radius == b.radius && a.x == b.x && a.open_direction == b.open_direction;
    sound = sound && std::abs(length(b.normal) - 1) < 1e-4f &&
            dot(a.normal, b.normal) > std::cos(max_normal_tilt) - 1e-4f;
    const TracedView& view = tilted.views[b.view];
    const Vec3 in_view = view.normal[std::size_t(b.y) * view.camera.width + b.x];
    same = same && in_view == b.normal;
    if (!(a.normal == b.normal)) views.insert(b.view);
  }
  CHECK(sound);
  CHECK(same);
  // A half of 24 views. Smooth normals of a scene of boxes equal the normals of its faces.
  CHECK(views.size() >= 5);
  CHECK(views.size() <= 19);
}

TEST_CASE("smooth normals of a coarse ball equal the normals of the round one") {
  bake::TriangleSoup soup;
  add_ellipsoid(soup, standing_frame({0, 0, 0}, 0), {1, 1, 1}, 24);
  const bake::RayScene rays(soup);
  float worst_face = 1, worst_smooth = -1;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    // The seed draws the kind; the best ones are smooth and have no map.
    const HostNormals normals(soup, 1, seed);
    float face = 1, smooth = 1;
    bake::Random random(1);
    for (int i = 0; i < 200; ++i) {
      const Vec3 out = any_direction(random);
      const bake::RayHit hit = rays.nearest(2.0f * out, -out);
      face = std::min(face, dot(hit.normal, out));
      smooth = std::min(smooth, dot(normals.at(hit, 2.0f * out, -out), out));
    }
    worst_face = face;
    worst_smooth = std::max(worst_smooth, smooth);
  }
  INFO(worst_face << " " << worst_smooth);
  CHECK(worst_face < 0.99f);
  CHECK(1 - worst_smooth < 0.3f * (1 - worst_face));
}

TEST_CASE("the level set of a ball is as large as the ball, and closed") {
  bake::TriangleSoup soup;
  add_level_set(soup, standing_frame({1, 2, 3}, 0.5f), {-1, -1, -1}, {1, 1, 1}, 0.1f,
                [](Vec3 p) { return length(p) - 0.8f; });
  const bake::RayScene rays(soup);
  bake::Random random(2);
  bool near = true;
  for (int i = 0; i < 500; ++i) {
    const float found = rays.nearest({1, 2, 3}, any_direction(random)).distance;
    near = near && found < 0.801f && found > 0.79f;
  }
  CHECK(near);
}

TEST_CASE("a view of a wall has the wall's depth and normal") {
  bake::TriangleSoup soup;
  add_block(soup, {-50, -50, -1}, {50, 50, 0});
  const bake::RayScene rays(soup);
  // 4 m in front of the face z = 0, aslant.
  const Camera camera = look_at({1, 2, 4}, {2, 1, 0}, 0.3f, 1, 64, 36);
  const TracedView view = trace_view(rays, camera);
  for (std::uint32_t i = 0; i < 64 * 36; ++i) {
    const PixelRay ray = pixel_ray(camera, float(i % 64) + 0.5f, float(i / 64) + 0.5f);
    REQUIRE(std::abs(ray.origin_ws.z + view.depth[i] * ray.direction_ws.z) < 1e-4f);
    const Vec3 normal_ws = transform_vector(camera.world_from_view, view.normal[i]);
    REQUIRE(length(normal_ws - Vec3{0, 0, 1}) < 1e-4f);
  }
}

TEST_CASE("a sheet of revolution is as wide as its profile, and open where that ends") {
  bake::TriangleSoup soup;
  add_lathe(soup, standing_frame({0, 0, 0}, 0), {{{1, 0}, {2, 1}}}, 64);
  const bake::RayScene rays(soup);
  for (const float height : {0.1f, 0.5f, 0.9f})
    for (const float angle : {0.0f, 1.0f, 4.0f}) {
      const Vec3 out{std::cos(angle), 0, std::sin(angle)};
      const float found = rays.nearest({0, height, 0}, out).distance;
      // 64 sides lie inside the circle by at most 1 - cos(pi / 64).
      CHECK(found <= (1 + height) * 1.0001f);
      CHECK(found >= (1 + height) * 0.9987f);
    }
  for (const float up : {-1.0f, 1.0f}) CHECK(!std::isfinite(rays.nearest({0, 0.5f, 0}, {0, up, 0}).distance));
}

TEST_CASE("rays end at each receiver's own radius") {
  // A ceiling 1 m above the floor hides everything within sight of a long ray and nothing of a short one.
  bake::TriangleSoup soup;
  add_block(soup, {-100, 1, -100}, {100, 2, 100});
  const std::vector<Vec3> position(3, Vec3{0, 0, 0}), normal(3, Vec3{0, 1, 0});
  const std::vector<float> radius{0.5f, 1000, 2};
  bake::AoSettings settings;
  settings.rays = 1024;
  const std::vector<float> ao = bake::trace_ao(bake::RayScene(soup), {position, normal, radius}, settings);
  CHECK(ao[0] == 1);
  // The share that a ceiling of 100 m half width leaves open is below 1 / (100^2 + 1).
  CHECK(ao[1] < 0.005f);
  // Rays of length 2 reach the ceiling within 60 degrees of the normal: cos^2 60 stays open. Stratified
  // noise.
  CHECK(std::abs(ao[2] - 0.25f) < 0.02f);
}

TEST_CASE("a training set that cannot be made is refused, and one can be stopped") {
  DatasetSettings settings = test::small_settings();
  settings.scenes = 2 * family_count - 1;
  CHECK_THROWS_AS(make_dataset(settings), Failure);
  settings = test::small_settings();
  settings.host_normal_share = 1.5f;
  CHECK_THROWS_AS(make_dataset(settings), Failure);
  settings = test::small_settings();
  settings.views = 3;
  CHECK_THROWS_AS(make_dataset(settings), Failure);
  try {
    make_dataset(test::small_settings(), [](std::size_t done, std::size_t) { return done < 2; });
    FAIL("was not stopped");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_CANCELLED);
  }
}
