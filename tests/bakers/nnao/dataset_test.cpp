#include "bakers/nnao/dataset.h"

#include <tbb/global_control.h>

#include <cmath>
#include <cstring>
#include <set>

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
        a[i].ao != b[i].ao)
      return false;
  return true;
}

}  // namespace

TEST_CASE("a training set is the same on one thread and on four, and another for another seed") {
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return test::small_dataset();
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
  for (const DataPoint& point : data.training) training.insert(point.view % 20);
  for (const DataPoint& point : data.validation) validation.insert(point.view % 20);
  for (const std::uint32_t scene : training) CHECK(validation.count(scene) == 0);
  CHECK(training.size() == 10);
  CHECK(validation.size() == 10);
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
    low += point.ao < 0.3f;
    high += point.ao > 0.9f;
  }
  CHECK(sound);
  // Something to learn: dark points and open ones. Compilers draw the random scenes in different orders: 24
  // dark points of 2,498 with clang 16 are the fewest.
  CHECK(low > 0.005 * double(data.training.size()));
  CHECK(high > 0.1 * double(data.training.size()));
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
  settings.scenes = 19;
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
