// Which casters a scene picks: the nearest, and what the cut-off may leave out.
#include <algorithm>
#include <array>
#include <chrono>

#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

std::vector<std::uint32_t> brute_force(const std::vector<Vec3>& points, std::uint32_t self, std::uint32_t k,
                                       float limit) {
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Vec3 d = points[i] - points[self];
    if (i != self && dot(d, d) <= limit * limit) all.push_back({dot(d, d), i});
  }
  std::ranges::sort(all, [](const Neighbour& a, const Neighbour& b) {
    return a.distance_squared != b.distance_squared ? a.distance_squared < b.distance_squared
                                                    : a.slot < b.slot;
  });
  std::vector<std::uint32_t> slots;
  for (std::size_t i = 0; i < std::min<std::size_t>(k, all.size()); ++i) slots.push_back(all[i].slot);
  return slots;
}

void build(NeighbourTree& tree, const std::vector<Vec3>& points) {
  reserve_tree(tree, points.size());
  clear_tree(tree);
  for (std::uint32_t i = 0; i < points.size(); ++i) add_to_tree(tree, i, points[i]);
  build_tree(tree);
}

void compare(const std::vector<Vec3>& points, std::uint32_t k, float limit) {
  NeighbourTree tree(nook::default_memory());
  build(tree, points);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::array<Neighbour, max_nearest> found;
    const std::uint32_t count = find_nearest(tree, i, points[i], k, limit, found);
    std::vector<std::uint32_t> slots;
    for (std::uint32_t f = 0; f < count; ++f) slots.push_back(found[f].slot);
    REQUIRE(slots == brute_force(points, i, k, limit));
  }
}

}  // namespace

TEST_CASE("the tree finds what brute force finds") {
  Numbers numbers(77);
  const auto points_in = [&](std::uint32_t count, Vec3 half) {
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Vec3 p = numbers.place(1);
      points.push_back({p.x * half.x, p.y * half.y, p.z * half.z});
    }
    return points;
  };
  for (const std::uint32_t k : {1u, 4u, 16u})
    for (const float limit : {0.5f, 3.0f, 1e4f, 1e30f}) {
      compare(points_in(300, {20, 0.1f, 20}), k, limit);  // a crowd on the ground
      compare(points_in(200, {5, 5, 5}), k, limit);
      compare(points_in(3, {5, 5, 5}), k, limit);
      compare({{1, 2, 3}}, k, limit);
      compare({}, k, limit);
      compare(std::vector<Vec3>(100, Vec3{4, 5, 6}), k, limit);

      auto outliers = points_in(150, {3, 3, 3});  // two far away, and some in one place
      outliers.push_back({1e6f, 0, 0});
      outliers.push_back({-1e6f, 5, 1e7f});
      outliers.insert(outliers.end(), 20, Vec3{1, 1, 1});
      compare(outliers, k, limit);
    }
}

TEST_CASE("the nearest points cost about the same in one place as spread out") {
  constexpr std::uint32_t count = 10'000, k = 4;
  Numbers numbers(12);
  std::vector<Vec3> spread, piled(count, Vec3{3, 1, 2}), mixed;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Vec3 p = numbers.place(1);
    spread.push_back({p.x * 70, p.y * 0.1f, p.z * 70});
    mixed.push_back(i % 5 ? p * 1e-3f : spread.back());
  }
  const auto seconds = [&](const std::vector<Vec3>& points) {
    NeighbourTree tree(nook::default_memory());
    double best = 1e9;
    for (int trial = 0; trial < 3; ++trial) {
      const auto start = std::chrono::steady_clock::now();
      build(tree, points);
      std::uint32_t found_in_all = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        std::array<Neighbour, max_nearest> found;
        found_in_all += find_nearest(tree, i, points[i], k, 100, found);
      }
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
      best = std::min(best, taken.count());
      CHECK(found_in_all == count * k);
    }
    return best;
  };
  const double even = seconds(spread);
  // A search that looks at all points of a pile takes 28 times as long here; a factor of 5 is left to caches
  // and to other processes.
  CHECK(seconds(piled) < 5 * even);
  CHECK(seconds(mixed) < 5 * even);
}

TEST_CASE("link_nearest adds to explicit links and counts no pair twice") {
  Scene scene = make_scene();
  const auto model = load(single_model({0, 1, 0}, 0.4f));
  std::vector<nook_instance_id> ids;
  for (int i = 0; i < 6; ++i) ids.push_back(place(scene, model, {static_cast<float>(i), 0, 0}));
  link(scene, ids[0], ids[1]);
  link(scene, ids[0], ids[5]);
  link_nearest(scene, 2, 3);
  update(scene);
  const auto slot = [&](int i) {
    return static_cast<std::uint32_t>(&instance_of(scene, ids[i]) - scene.instances.data());
  };
  CHECK(instance_of(scene, ids[0]).plan.casters == nook::Vector<std::uint32_t>{slot(1), slot(2), slot(5)});
  CHECK(instance_of(scene, ids[3]).plan.casters == nook::Vector<std::uint32_t>{slot(2), slot(4)});
  link_nearest(scene, 0, 0);
  update(scene);
  CHECK(instance_of(scene, ids[3]).plan.casters.empty());
  CHECK_THROWS_AS(link_nearest(scene, 17, 1), Failure);
  CHECK_THROWS_AS(link_nearest(scene, 1, 0), Failure);
}

TEST_CASE("the bound of a posed instance holds its spheres and key points") {
  Numbers numbers(5);
  const auto model = load(sample_model(21, {8, 30, 60, 50, 0, 4}));
  for (int trial = 0; trial < 20; ++trial) {
    Scene scene = make_scene();
    const nook_instance_id id = add_instance(scene, model);
    std::vector<Mat3x4> pose;
    for (std::size_t b = 0; b < model->model.bone_count(); ++b)
      pose.push_back(
          stiff_pose(model->model, numbers.place(2), numbers.between(-3, 3), numbers.between(0.3f, 2))[0]);
    set_pose(scene, id, pose);
    update(scene);
    const Instance& instance = instance_of(scene, id);
    const float reach = instance.input.bound.radius * (1 + 1e-5f);
    const SphereLanes& s = instance.arrays().spheres;
    for (std::uint32_t i = 0; i < s.count; ++i)
      CHECK(length(Vec3{s.x[i], s.y[i], s.z[i]} - instance.input.bound.centre) + 1 / s.inverse_radius[i] <=
            reach);
    const PointLanes& p = instance.arrays().points;
    for (std::uint32_t i = 0; i < p.count; ++i) {
      CHECK(length(Vec3{p.x[i], p.y[i], p.z[i]} - instance.input.bound.centre) <= reach);
      CHECK(length(Vec3{p.surface_x[i], p.surface_y[i], p.surface_z[i]} - instance.input.bound.centre) <=
            reach);
    }
  }
}

TEST_CASE("what the cut-off leaves out darkens by less than it says") {
  const auto form = GENERATE(KernelForm::paper, KernelForm::nook, KernelForm::rational);
  const nook_form combine = GENERATE(nook_form{NOOK_FORM_DEFAULT}, nook_form{NOOK_FORM_PAPER});
  CharacterModel data = sample_model(31, {4, 20, 40, 80, 0, 4});
  data.kernel.form = form;
  const auto model = load(std::move(data));
  std::uint32_t culled = 0, kept = 0;
  for (const float cutoff : {0.3f, 0.05f, 0.01f, 1.0f / 1024})
    for (float distance = 1; distance < 300; distance *= 1.3f) {
      const auto run = [&](float cutoff_error) {
        SceneSettings settings;
        settings.cutoff_error = cutoff_error;
        settings.form = combine;
        Scene scene = make_scene(settings);
        const nook_instance_id id = add_instance(scene, model);
        link(scene, id, place(scene, model, {distance, 0.2f, 0}, distance, 1.4f));
        update(scene);
        culled += scene.stats.links_culled;
        kept += scene.stats.links;
        return ao_of(scene, id);
      };
      const std::vector<float> all = run(0), some = run(cutoff);
      // One caster was left out at most; the rest is rounding.
      CHECK(largest_difference(all, some) < cutoff + 1e-6f);
    }
  CHECK(culled > 5);
  CHECK(kept > culled);
}

TEST_CASE("an occluder of one instance darkens no other") {
  Scene scene = make_scene();
  const auto model = load(single_model({0, 50, 0}, 0.1f));
  const nook_instance_id bearer = add_instance(scene, model), other = add_instance(scene, model);
  const nook_occluder_id shield = add_occluder(scene, {{0, 1, 0}, 0.5f});
  update(scene);
  const std::vector<float> dark = ao_of(scene, bearer);
  CHECK(dark[0] < 0.8f);
  CHECK(ao_of(scene, other) == dark);
  set_occluder(scene, shield, {{0, 1, 0}, 0.5f}, bearer);
  update(scene);
  CHECK(ao_of(scene, bearer) == dark);
  CHECK(ao_of(scene, other)[0] > 0.99f);
  // The id of a removed instance comes never back, so that its shield darkens none.
  remove_instance(scene, bearer);
  const nook_instance_id next = add_instance(scene, model);
  update(scene);
  CHECK(ao_of(scene, next)[0] > 0.99f);
  set_occluder(scene, shield, {{0, 1, 0}, 0.5f});
  update(scene);
  CHECK(ao_of(scene, next) == dark);
}
