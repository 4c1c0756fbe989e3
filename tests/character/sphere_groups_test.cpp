// Groups and trees of spheres against the sum over the spheres themselves.
#include "sdk/src/character/sphere_groups.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "sdk/src/character/sphere_tree.h"
#include "tests/catch.h"
#include "tests/character/kernel_reference.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// All tiers of a model in a stiff pose, and the spheres themselves.
struct Posed {
  explicit Posed(const CharacterModel& model, std::span<const Mat3x4> pose)
      : spheres(model), groups(model), lanes(4 * count(), default_memory()) {
    float* at = lanes.data();
    const SphereTarget target{at, at + count(), at + 2 * count(), at + 3 * count()};
    best_shadow_kernels().pose_spheres(spheres.view(), pose.data(), {}, target);
    all = {
        target.x, target.y, target.z, target.inverse_radius, spheres.caster_weight(), spheres.view().count};
    SphereSoa parts = all;
    const float* moments = nullptr;
    for (std::uint32_t t = 0; t < group_tiers; ++t) {
      storage[t] = AlignedArray<float>(group_lanes * simd_width, default_memory());
      float* g = storage[t].data();
      const GroupLanes out{g,
                           g + simd_width,
                           g + 2 * simd_width,
                           g + 3 * simd_width,
                           g + 4 * simd_width,
                           g + 5 * simd_width,
                           groups.tier(t).count()};
      merge_groups(groups.tier(t), parts, moments, out);
      lanes_of[t] = out;
      moments = out.moment;
      tier[t] = parts = {out.x, out.y, out.z, out.inverse_radius, out.caster_weight, out.count};
    }
  }
  std::size_t count() const { return padded_count(spheres.view().count); }

  RestSpheres spheres;
  SphereGroups groups;
  AlignedArray<float> lanes, storage[group_tiers];
  SphereSoa all, tier[group_tiers];
  GroupLanes lanes_of[group_tiers];
};

double mass_of(const SphereSoa& spheres) {
  double sum = 0;
  for (std::uint32_t i = 0; i < spheres.count; ++i)
    sum += double(spheres.caster_weight[i]) / double(spheres.inverse_radius[i] * spheres.inverse_radius[i]);
  return sum;
}

// Sum over spheres of mass * (distance from the middle of their group)^2.
double moment_by_spheres(const Posed& posed, std::uint32_t t) {
  std::vector<std::uint32_t> group(posed.all.count);
  for (std::uint32_t s = 0; s < posed.all.count; ++s) group[s] = s;
  for (std::uint32_t finer = 0; finer <= t; ++finer) {
    const SphereGroups::Tier& tier = posed.groups.tier(finer);
    std::vector<std::uint32_t> above(tier.member.size());
    for (std::uint32_t g = 0; g < tier.count(); ++g)
      for (std::uint32_t i = tier.first[g]; i < tier.first[g + 1]; ++i) above[tier.member[i]] = g;
    for (std::uint32_t& of_sphere : group) of_sphere = above[of_sphere];
  }
  double sum = 0;
  for (std::uint32_t s = 0; s < posed.all.count; ++s) {
    const std::uint32_t g = group[s];
    const double dx = double(posed.all.x[s]) - double(posed.tier[t].x[g]),
                 dy = double(posed.all.y[s]) - double(posed.tier[t].y[g]),
                 dz = double(posed.all.z[s]) - double(posed.tier[t].z[g]);
    sum += double(posed.all.caster_weight[s]) /
           double(posed.all.inverse_radius[s] * posed.all.inverse_radius[s]) * (dx * dx + dy * dy + dz * dz);
  }
  return sum;
}

// Points of a body at the origin.
struct BodyPoints {
  static constexpr std::uint32_t count = 1024;

  explicit BodyPoints(std::uint32_t seed) : lanes(6 * count) {
    Numbers numbers(seed);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Vec3 p = numbers.place(0.4f), n = numbers.direction();
      const float value[] = {p.x, p.y, p.z, n.x, n.y, n.z};
      for (std::uint32_t a = 0; a < 6; ++a) lanes[a * count + k] = value[a];
    }
  }
  KeyPointSoa view() const {
    const float* at = lanes.data();
    return {at, at + count, at + 2 * count, at + 3 * count, at + 4 * count, at + 5 * count, count};
  }
  Receiver receiver() const { return receiver_of(view().x, view().y, view().z, count, 1); }

  std::vector<float> lanes;
};

// The darkening of the points by spheres, which are posed elsewhere.
std::vector<float> depths(const SphereSoa& spheres, const BodyPoints& points) {
  std::vector<float> depth(BodyPoints::count, 0.0f);
  best_shadow_kernels().composed_depth(spheres, points.view(), depth.data());
  return depth;
}

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * double(a[i] - b[i]);
  return std::sqrt(sum / double(a.size()));
}

CharacterModel body(std::uint32_t seed) {
  return sample_model(seed, {8, 130, 60, 50, 0, 4});
}

}  // namespace

TEST_CASE("each sphere is in one group, and groups are made of groups") {
  const SphereGroups groups(body(3));
  std::uint32_t parts = 130;
  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    const SphereGroups::Tier& tier = groups.tier(t);
    CHECK(tier.count() == tier_groups[t]);
    std::vector<std::uint32_t> members(tier.member.begin(), tier.member.end());
    std::sort(members.begin(), members.end());
    REQUIRE(members.size() == parts);
    for (std::uint32_t i = 0; i < parts; ++i) CHECK(members[i] == i);
    CHECK(tier.first[0] == 0);
    for (std::uint32_t g = 0; g < tier.count(); ++g) CHECK(tier.first[g] < tier.first[g + 1]);
    CHECK(tier.first[tier.count()] == parts);
    parts = tier.count();
  }
}

TEST_CASE("fewer spheres than groups are groups of their own") {
  CharacterModel model = sample_model(4, {2, 3, 8, 8, 0, 4});
  for (ProxySphere& sphere : model.spheres) sphere.centre = {0.1f, 0.2f, 0.3f};  // nothing to split by
  model.spheres[1].caster_weight = 0;
  const Posed posed(model, stiff_pose(model, {}));
  CHECK(posed.tier[0].count == 3);
  CHECK(posed.tier[1].count == 3);
  CHECK(posed.tier[2].count == 2);
  for (std::uint32_t t = 0; t < group_tiers; ++t) {
    for (std::uint32_t g = 0; g < posed.lanes_of[t].count; ++g) CHECK(posed.lanes_of[t].moment[g] == 0);
    CHECK(std::abs(mass_of(posed.tier[t]) - mass_of(posed.all)) < 1e-6 * mass_of(posed.all));
  }
}

TEST_CASE("groups keep mass and centre, and change a far receiver by less than their estimate") {
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const CharacterModel model = body(seed);
    for (const float distance : {2.0f, 3.0f, 6.0f}) {
      const Posed posed(model, stiff_pose(model, {distance, 0, 0}, float(seed)));
      const BodyPoints points(seed);
      const std::vector<float> exact = depths(posed.all, points);
      for (std::uint32_t t = 0; t < group_tiers; ++t) {
        INFO("seed " << seed << ", distance " << distance << ", tier " << t);
        CHECK(std::abs(mass_of(posed.tier[t]) - mass_of(posed.all)) < 1e-5 * mass_of(posed.all));
        double moment = 0;
        for (std::uint32_t g = 0; g < posed.lanes_of[t].count; ++g)
          moment += double(posed.lanes_of[t].moment[g]);
        CHECK(std::abs(moment - moment_by_spheres(posed, t)) < 1e-4 * moment);
        const double change = rms_difference(depths(posed.tier[t], points), exact);
        // The form factor of the kernels has a relative error of 0.002, and the sum of all factors is a
        // hundredth here.
        CHECK(change < double(group_error(posed.lanes_of[t], points.receiver())) + 1e-5);
        CHECK(change > 0);
      }
    }
  }
}

TEST_CASE("a scene groups what is far, by the pose, and nothing that is near") {
  CharacterModel data = body(5);
  const auto model = load(std::move(data));
  struct Run {
    std::vector<float> ao;
    std::uint64_t evaluations;
  };
  const auto run = [&](float far_error, float distance, float apart) {
    SceneSettings settings;
    settings.cutoff_error = 0;
    settings.far_error = far_error;
    Scene scene = make_scene(settings);
    scene.terms = NOOK_TERM_LINKS;
    const nook_instance_id receiver = add_instance(scene, model),
                           caster = place(scene, model, {distance, 0, 0});
    // The even bones move away from the odd ones.
    std::vector<Mat3x4> pose = stiff_pose(model->model, {distance, 0, 0});
    for (std::size_t b = 0; b < pose.size(); b += 2) pose[b].m[7] += apart;
    set_pose(scene, caster, pose);
    update(scene);  // without a link first: groups come with it
    link(scene, receiver, caster);
    update(scene);
    return Run{ao_of(scene, receiver), scene.stats.evaluations};
  };
  const float error = SceneSettings().far_error;
  const Run near = run(error, 0.6f, 0), near_exact = run(0, 0.6f, 0);
  CHECK(near.ao == near_exact.ao);
  CHECK(near.evaluations == near_exact.evaluations);
  const Run far = run(error, 4, 0), far_exact = run(0, 4, 0);
  CHECK(far.evaluations < far_exact.evaluations);
  CHECK(rms_difference(far.ao, far_exact.ao) < double(error));
  CHECK(far.ao != far_exact.ao);
  CHECK(run(error, 4, 0).ao == far.ao);
  const Run torn = run(error, 4, 3);
  CHECK(torn.evaluations > far.evaluations);
}

TEST_CASE("the change stays below far_error at every distance, where arms reach each other too") {
  // Bodies in which a bone reaches far out: its spheres are in reach of the receiver when the middles are
  // not.
  CharacterModel data = body(6);
  for (ProxySphere& sphere : data.spheres)
    if (sphere.bone == 0) sphere.centre += Vec3{-1.2f, 0, 0};
  for (KeyPoint& point : data.key_points)
    if (point.bone[0] == 0) {
      point.position += Vec3{1.0f, 0, 0};
      point.surface_position += Vec3{1.0f, 0, 0};
    }
  const auto model = load(std::move(data));
  const auto ao = [&](float far_error, Vec3 place_m, float turn, std::uint64_t& evaluations) {
    SceneSettings settings;
    settings.cutoff_error = 0;
    settings.far_error = far_error;
    Scene scene = make_scene(settings);
    scene.terms = NOOK_TERM_LINKS;
    const nook_instance_id receiver = add_instance(scene, model), caster = add_instance(scene, model);
    set_pose(scene, receiver, stiff_pose(model->model, {}));
    set_pose(scene, caster, stiff_pose(model->model, place_m, turn));
    link(scene, receiver, caster);
    update(scene);
    evaluations = scene.stats.evaluations;
    return ao_of(scene, receiver);
  };
  const float allowed = SceneSettings().far_error;
  std::uint32_t grouped = 0;
  for (float distance = 0.5f; distance < 8; distance *= 1.3f)
    for (int turn = 0; turn < 6; ++turn) {
      INFO("distance " << distance << ", turn " << turn);
      std::uint64_t evaluations = 0, exact_evaluations = 0;
      const std::vector<float> merged = ao(allowed, {distance, 0, 0}, float(turn), evaluations),
                               exact = ao(0, {distance, 0, 0}, float(turn), exact_evaluations);
      CHECK(rms_difference(merged, exact) < double(allowed));
      grouped += evaluations < exact_evaluations;
    }
  // The distances are from 0.5 to 6.9 m, and the spheres reach 1.6 m from the middle: about the farthest
  // third of the 66 can be grouped.
  CHECK(grouped > 12);
}

TEST_CASE("a tree holds each sphere once, and each node but the first is half of one before it") {
  const CharacterModel model = body(3);
  const SphereTree tree(model);
  std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
  std::sort(order.begin(), order.end());
  REQUIRE(order.size() == 130);
  for (std::uint32_t i = 0; i < 130; ++i) CHECK(order[i] == i);
  const auto& nodes = tree.nodes();
  REQUIRE(nodes.size() == 129);
  std::vector<int> uses(129 + 130, 0);
  for (std::uint32_t n = 0; n < nodes.size(); ++n)
    for (const std::uint16_t half : nodes[n].half) {
      REQUIRE(half < uses.size());
      CHECK(half > n);
      ++uses[half];
    }
  CHECK(uses[0] == 0);
  CHECK(std::count(uses.begin(), uses.end(), 1) == 258);
  CharacterModel other = body(3);
  other.kernel.gamma = 1.5f;
  CHECK(SphereTree(other).is_empty());
  other = body(3);
  other.spheres.resize(1);
  CHECK(SphereTree(other).is_empty());
}

TEST_CASE("a node has the mass of its spheres, at their centre of mass") {
  const CharacterModel model = body(4);
  const SphereTree tree(model);
  const Posed posed(model, stiff_pose(model, {0.3f, 0, 0}, 0.4f, 1.2f));
  const auto pose = std::make_unique<PosedSphereTree>();
  pose_tree(tree, posed.all, 1.0f / 1024, *pose);
  double mass = 0, x = 0;
  for (std::uint32_t i = 0; i < 130; ++i) {
    const double squared = 1 / (double(posed.all.inverse_radius[i]) * posed.all.inverse_radius[i]);
    mass += squared;
    x += squared * posed.all.x[i];
  }
  // Sums of 130 floats in a tree of some ten levels.
  CHECK(std::abs(pose->mass[0] - 0.75 * mass) < 3e-6 * mass);
  CHECK(std::abs(pose->x[0] - x / mass) < 3e-6);
}

TEST_CASE(
    "a tree gives the sum over its spheres where nothing may change, and less work where something may") {
  for (const std::uint32_t seed : {1u, 2u, 3u}) {
    CharacterModel model = body(seed);
    // Three parts of a body, as limbs are.
    for (ProxySphere& sphere : model.spheres) {
      sphere.centre = sphere.centre * 0.5f + Vec3{float(sphere.bone % 3), 0, 0};
      sphere.radius *= 0.3f;
    }
    const SphereTree tree(model);
    const Posed posed(model, stiff_pose(model, {0.3f, 0, 0}, 0.4f, 1.2f));
    for (const ShadowKernels* kernels : available_kernels()) {
      INFO("seed " << seed << ", " << kernels->name);
      const BodyPoints points(seed);
      std::vector<float> plain(BodyPoints::count, 0.0f), whole = plain, merged = plain;
      kernels->self_norm_sum(posed.all, points.view(), {}, plain.data());
      PosedSphereTree lanes;
      CHECK(kernels->tree_sum(pose_tree(tree, posed.all, 0, lanes), points.view(), whole.data()) ==
            130ull * BodyPoints::count);
      // Each is within 2e-4 of the formula for shadows above 1, and these are all below.
      for (std::size_t k = 0; k < plain.size(); ++k) CHECK(std::abs(whole[k] - plain[k]) < 2e-4f);
      const float error = 1.0f / 1024;
      CHECK(kernels->tree_sum(pose_tree(tree, posed.all, error, lanes), points.view(), merged.data()) <
            100ull * BodyPoints::count);
      CHECK(rms_difference(merged, whole) < double(error));
      CHECK(rms_difference(merged, whole) > 0);
    }
  }
}

TEST_CASE("a key point beside a sphere is shadowed by it, however little the sphere counts in a node") {
  CharacterModel model = body(1);
  model.spheres.resize(2);
  model.spheres[0] = {{0, 0, 0}, 0.3f, 0};
  model.spheres[1] = {{1, 0, 0}, 0.002f, 0};
  const SphereTree tree(model);
  const Posed posed(model, std::vector<Mat3x4>(model.bone_count()));
  // They stand 3 mm above the small sphere and look down at it.
  std::vector<float> lanes(6 * key_point_group, 0.0f);
  std::fill_n(&lanes[0], key_point_group, 1.0f);
  std::fill_n(&lanes[key_point_group], key_point_group, 0.003f);
  std::fill_n(&lanes[4 * key_point_group], key_point_group, -1.0f);
  const float* const at = lanes.data();
  const KeyPointSoa points{at,
                           at + key_point_group,
                           at + 2 * key_point_group,
                           at + 3 * key_point_group,
                           at + 4 * key_point_group,
                           at + 5 * key_point_group,
                           key_point_group};
  const float error = 1.0f / 256;
  for (const ShadowKernels* kernels : available_kernels()) {
    INFO(kernels->name);
    PosedSphereTree pose;
    std::vector<float> whole(key_point_group, 0.0f), merged = whole;
    kernels->tree_sum(pose_tree(tree, posed.all, 0, pose), points, whole.data());
    kernels->tree_sum(pose_tree(tree, posed.all, error, pose), points, merged.data());
    CHECK(whole[0] > 0.2f);
    CHECK(std::abs(merged[0] - whole[0]) < error);
  }
}
