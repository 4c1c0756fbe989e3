// The results of a scene against numbers that were computed by hand.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "sdk/src/character/kernel.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// Float arithmetic and the reciprocal square roots of the SIMD kernels, some ten operations deep.
constexpr float rounding = 2e-5f;
// form_factor_fast against form_factor_exact is exact for an unclipped sphere, so that rounding is all there
// is.

bool near(float got, double want, float tolerance = rounding) {
  return std::abs(got - want) < tolerance;
}

template <class Body>
std::string failure_of(nook_result code, Body&& body) {
  try {
    body();
  } catch (const Failure& failure) {
    CHECK(failure.code() == code);
    return failure.what();
  }
  return "no failure";
}

using Slots = nook::Vector<std::uint32_t>;

std::uint32_t slot_of(const Scene& scene, nook_instance_id id) {
  return static_cast<std::uint32_t>(&instance_of(scene, id) - scene.instances.data());
}

bool mentions(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("one sphere over one key point gives the paper's shadow") {
  CharacterModel model = single_model({0, 1, 0}, 0.25f, 0.8f, 0.05f);
  model.kernel = {KernelForm::paper, 1.5f};
  Scene scene = make_scene();
  const nook_instance_id id = add_instance(scene, load(model));
  update(scene);
  // delta = xi = 4 radii; slide 18. The norm of a single term is the term.
  const double omega = 0.75 - 3 * (4 - 1) / (1 + 4 * (4.0 - 1)), lambda = 0.5 + 4 / std::sqrt(1 + 4 * 16.0);
  CHECK(near(ao_of(scene, id)[0], 1 - (0.8 * omega * lambda + 0.05)));
}

TEST_CASE("before its first update an instance is open") {
  Scene scene = make_scene();
  const nook_instance_id id = add_instance(scene, load(single_model({0, 1, 0}, 0.25f)));
  CHECK(ao_of(scene, id)[0] == 1);
}

TEST_CASE("a linked caster darkens by its form factor, and no more once unlinked") {
  const auto model = load(single_model({0, -3, 0}, 0.01f, 0.5f));
  CharacterModel caster_model = single_model({0, 0, 0}, 0.3f);
  caster_model.spheres[0].caster_weight = 0.7f;
  Scene scene = make_scene();
  const nook_instance_id receiver = add_instance(scene, model);
  const nook_instance_id caster = place(scene, load(caster_model), {0, 2, 0});
  update(scene);
  const float alone = ao_of(scene, receiver)[0];

  link(scene, receiver, caster);
  link(scene, receiver, caster);
  update(scene);
  // Overhead and wholly visible: f = (r / d)^2; weighted, as optical depth.
  CHECK(near(ao_of(scene, receiver)[0], alone * std::exp(-solid_depth(0.7 * 0.3 * 0.3 / 4))));
  CHECK(scene.stats.links == 1);

  // The caster stays as it was: links have a direction.
  set_pose(scene, caster, stiff_pose(caster_model, {0, -2, 0}));
  update(scene);
  CHECK(near(ao_of(scene, receiver)[0], alone));  // below the horizon

  set_pose(scene, caster, stiff_pose(caster_model, {0, 2, 0}));
  unlink(scene, receiver, caster);
  update(scene);
  CHECK(ao_of(scene, receiver)[0] == alone);
  CHECK(mentions(failure_of(NOOK_ERROR_INVALID_HANDLE, [&] { unlink(scene, receiver, caster); }),
                 "not linked"));
}

TEST_CASE("in the paper's form a linked caster joins the norm") {
  CharacterModel model = single_model({0, 1, 0}, 0.25f);
  model.kernel = {KernelForm::paper, 2.0f};
  SceneSettings settings;
  settings.form = NOOK_FORM_PAPER;
  Scene scene = make_scene(settings);
  const auto loaded = load(model);
  const nook_instance_id receiver = add_instance(scene, loaded);
  link(scene, receiver, place(scene, loaded, {0, 0, 0}));
  update(scene);
  const double omega = 0.75 - 3 * (4 - 1) / (1 + 4 * (4.0 - 1)), lambda = 0.5 + 4 / std::sqrt(1 + 4 * 16.0);
  CHECK(near(ao_of(scene, receiver)[0], 1 - std::sqrt(2.0) * omega * lambda));
}

TEST_CASE("a free occluder takes its exact form factor, until it is removed") {
  Scene scene = make_scene();
  const nook_instance_id id = add_instance(scene, load(single_model({0, -3, 0}, 0.01f)));
  update(scene);
  const float alone = ao_of(scene, id)[0];
  const nook_occluder_id occluder = add_occluder(scene, {{0, 2, 0}, 0.5f});
  update(scene);
  CHECK(near(ao_of(scene, id)[0], alone * (1 - 0.25 / 4)));
  // At 60 degrees from the normal and still above the horizon: cos 60 = 1/2.
  set_occluder(scene, occluder, {{2 * std::sin(1.0471976f), 1, 0}, 0.5f});
  update(scene);
  CHECK(near(ao_of(scene, id)[0], alone * (1 - 0.5 * 0.25 / 4)));
  remove_occluder(scene, occluder);
  update(scene);
  CHECK(ao_of(scene, id)[0] == alone);
  CHECK(mentions(failure_of(NOOK_ERROR_INVALID_HANDLE,
                            [&] {
                              set_occluder(scene, occluder, {{}, 1});
                            }),
                 "no occluder"));
  CHECK(add_occluder(scene, {{0, 2, 0}, 0.5f}) != occluder);
}

TEST_CASE("the ground is a sphere tangent to the plane below the instance") {
  CharacterModel model = single_model({0, 3, 0}, 0.01f);
  model.key_points[0].normal = model.key_points[0].surface_normal = {0, -1, 0};
  SceneSettings settings;
  settings.ground_radius = 10;
  Scene scene = make_scene(settings);
  const auto loaded = load(model);
  const nook_instance_id id = add_instance(scene, loaded);
  update(scene);
  const float alone = ao_of(scene, id)[0];
  const Plane plane{{0, 1, 0}, -1};
  set_ground(scene, id, &plane);
  // It follows the instance sideways: the same darkening anywhere above the plane.
  for (const float x : {0.0f, 50.0f}) {
    set_pose(scene, id, stiff_pose(model, {x, 0.5f, 0}));
    update(scene);
    CHECK(near(ao_of(scene, id)[0], alone * (1 - 10.0 * 10 / (11.5 * 11.5))));
  }
  set_ground(scene, id, nullptr);
  update(scene);
  CHECK(near(ao_of(scene, id)[0], alone));
  const Plane slack{{0, 2, 0}, 0};
  CHECK(mentions(failure_of(NOOK_ERROR_INVALID_ARGUMENT, [&] { set_ground(scene, id, &slack); }),
                 "unit length"));
}

TEST_CASE("a scene scaled, turned and moved as a whole keeps its AO") {
  const auto model = load(sample_model(11));
  const auto run = [&](float scale, float turn, Vec3 move) {
    SceneSettings settings;
    settings.cutoff_error = 0;
    settings.ground_radius = 100 * scale;
    Scene scene = make_scene(settings);
    const auto at = [&](Vec3 p) {
      const float c = std::cos(turn), s = std::sin(turn);
      return Vec3{c * p.x + s * p.z, p.y, c * p.z - s * p.x} * scale + move;
    };
    const nook_instance_id id = place(scene, model, at({}), turn, scale);
    link(scene, id, place(scene, model, at({1, 0.1f, 0.4f}), turn, scale));
    const Plane plane{{0, 1, 0}, -0.6f * scale + move.y};
    set_ground(scene, id, &plane);
    add_occluder(scene, {at({-1, 0.5f, 0}), 0.3f * scale});
    update(scene);
    return ao_of(scene, id);
  };
  const std::vector<float> plain = run(1, 0, {});
  CHECK(*std::ranges::min_element(plain) < 0.9f);  // something is dark at all
  // Coordinates of a few metres rounded to float move a 3 cm sphere by 1e-5 of its radius; a ground 100 m off
  // by less.
  CHECK(largest_difference(plain, run(2.5f, 0.7f, {3, -1, 2})) < 2e-4f);
  CHECK(largest_difference(plain, run(0.3f, -2, {})) < 2e-4f);
}

TEST_CASE("terms switch casters off one by one") {
  const auto model = load(sample_model(4));
  Scene scene = make_scene();
  const nook_instance_id id = add_instance(scene, model);
  link(scene, id, place(scene, model, {0.6f, 0, 0}));
  const Plane plane{{0, 1, 0}, -0.5f};
  set_ground(scene, id, &plane);
  add_occluder(scene, {{0, 1, 0}, 0.4f});
  std::vector<std::vector<float>> all;
  for (const std::uint32_t terms : {15u, 14u, 13u, 11u, 7u, 0u}) {
    scene.terms = terms;
    update(scene);
    all.push_back(ao_of(scene, id));
  }
  for (std::size_t i = 1; i < all.size(); ++i) CHECK(largest_difference(all[0], all[i]) > 1e-3f);
  CHECK(std::ranges::all_of(all.back(), [](float ao) { return ao == 1; }));
}

TEST_CASE("every instruction set and every division among threads gives the same AO") {
  const auto threads = [](void*, std::uint32_t count, nook_job_fn body, void* user) {
    const auto half = [=](std::uint32_t first) {
      for (std::uint32_t i = first; i < count; i += 2) body(user, i);
    };
    std::thread other(half, 1u);
    half(0);
    other.join();
  };
  const auto model = load(sample_model(6, {20, 30, 50, 300, 30, 8}));
  const auto run = [&](nook_isa isa, const Parallel& parallel) {
    SceneSettings settings;
    settings.isa = isa;
    Scene scene = make_scene(settings, parallel);
    std::vector<float> all;
    link_nearest(scene, 3, 4);
    std::vector<nook_instance_id> ids;
    for (int i = 0; i < 9; ++i)
      ids.push_back(
          place(scene, model, {1.3f * static_cast<float>(i % 3), 0, 1.1f * static_cast<float>(i / 3)}));
    update(scene);
    for (const nook_instance_id id : ids) std::ranges::copy(ao_of(scene, id), std::back_inserter(all));
    return all;
  };
  const std::vector<float> scalar = run(NOOK_ISA_SCALAR, {});
  CHECK(run(NOOK_ISA_SCALAR, {threads, nullptr}) == scalar);
  for (const Isa isa : all_isas)
    if (isa_available(isa))
      // The kernels' own tests bound each shadow by 1e-5; alphas of up to 4 x 0.6 add them up.
      CHECK(largest_difference(run(nook_isa(isa), {}), scalar) < 5e-5f);
}

TEST_CASE("a stride does not change the bytes between the values") {
  Scene scene = make_scene();
  const auto model = load(sample_model(8));
  const nook_instance_id id = add_instance(scene, model);
  update(scene);
  const std::vector<float> dense = ao_of(scene, id);
  std::vector<float> wide(dense.size() * 3, -7);
  read_ao(scene, instance_of(scene, id), wide.data(), 12);
  for (std::size_t i = 0; i < dense.size(); ++i) {
    CHECK(wide[3 * i] == dense[i]);
    CHECK((wide[3 * i + 1] == -7 && wide[3 * i + 2] == -7));
  }
}

TEST_CASE("file vertices of one welded vertex agree") {
  Scene scene = make_scene();
  const auto model = load(sample_model(8));
  const nook_instance_id id = add_instance(scene, model);
  update(scene);
  const std::vector<float> ao = ao_of(scene, id);
  const auto& welded = model->model.file_to_welded;
  REQUIRE(welded.size() > model->model.vertex_count());
  for (std::size_t i = 0; i < welded.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (welded[i] == welded[j]) CHECK(ao[i] == ao[j]);
}

TEST_CASE("a bad pose is refused, names its bone and changes nothing") {
  SceneSettings settings;
  settings.strict_poses = GENERATE(false, true);
  Scene scene = make_scene(settings);
  const auto model = load(sample_model());
  const nook_instance_id id = add_instance(scene, model);
  update(scene);
  const std::vector<float> before = ao_of(scene, id);
  const auto refusal = [&](auto&& damage) {
    auto pose = stiff_pose(model->model, {1, 2, 3}, 0.4f, 1.2f);
    damage(pose);
    return failure_of(NOOK_ERROR_INVALID_ARGUMENT, [&] { set_pose(scene, id, pose); });
  };
  CHECK(mentions(refusal([](auto& pose) { pose.pop_back(); }), "got 4, need 5"));
  CHECK(mentions(refusal([](auto& pose) { pose[3].m[7] = NAN; }), "bone 3"));
  CHECK(mentions(refusal([](auto& pose) { pose[2].m[3] = INFINITY; }), "bone 2"));
  if (settings.strict_poses) {
    CHECK(mentions(refusal([](auto& pose) { pose[1].m[5] *= 1.02f; }), "bone 1"));
    CHECK(mentions(refusal([](auto& pose) { pose[4].m[1] += 0.05f; }), "bone 4"));
  }
  update(scene);
  CHECK(ao_of(scene, id) == before);
  // Half a per cent is what exporters leave behind.
  CHECK(refusal([](auto& pose) { pose[1].m[5] *= 1.005f; }) == "no failure");
}

TEST_CASE("uneven matrices are projected to the nearest similarity, and noted") {
  Scene scene = make_scene();
  const auto model = load(sample_model());
  const nook_instance_id id = add_instance(scene, model);
  auto pose = stiff_pose(model->model, {1, 2, 3}, 0.4f, 1.2f);
  CHECK(set_pose(scene, id, pose).uneven == 0);
  const auto even = pose;
  // Squash and stretch about the joint, along an axis of the bone: the mean of the lengths is what stays.
  const Affine frame = [&] {
    Affine out;
    std::copy_n(model->model.bind.bones[2].node_from_rest.m, 12, out.m.begin());
    return inverse(out);
  }();
  const Vec3 joint{float(frame.m[3]), float(frame.m[7]), float(frame.m[11])};
  const Vec3 joint_ws = transform_point(pose[2], joint);
  for (int row = 0; row < 3; ++row) {
    pose[2].m[4 * row] *= 1.3f;
    pose[2].m[4 * row + 1] *= 0.7f;
  }
  const Vec3 moved = transform_point(pose[2], joint);
  pose[2].m[3] += joint_ws.x - moved.x;
  pose[2].m[7] += joint_ws.y - moved.y;
  pose[2].m[11] += joint_ws.z - moved.z;
  const PoseNotes notes = set_pose(scene, id, pose);
  CHECK(notes.uneven == 1);
  CHECK(notes.first == 2);
  const Instance& instance = instance_of(scene, id);
  // Rounding in float of numbers up to 3.
  for (int i = 0; i < 12; ++i) CHECK(std::abs(instance.bones()[2].m[i] - even[2].m[i]) < 2e-6f);

  // One axis and two axes of zero keep a finite AO, and a mirrored matrix stays mirrored.
  for (int zeros = 1; zeros <= 3; ++zeros) {
    auto flat = even;
    for (int axis = 0; axis < zeros; ++axis)
      for (int row = 0; row < 3; ++row) flat[1].m[4 * row + axis] = 0;
    set_pose(scene, id, flat);
    update(scene);
    for (const float ao : ao_of(scene, id)) CHECK((ao >= 0 && ao <= 1));
  }
  auto mirrored = even;
  for (Mat3x4& bone : mirrored)
    for (int row = 0; row < 3; ++row) bone.m[4 * row] *= -1.1f;
  set_pose(scene, id, mirrored);
  const float* m = instance.bones()[0].m;
  CHECK(dot(cross(Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}), Vec3{m[2], m[6], m[10]}) < -1);
}

TEST_CASE("a new model under a living instance gives what a new instance of it gives") {
  Scene scene = make_scene();
  const auto before = load(sample_model(1)), after = load(sample_model(2));
  const nook_instance_id changed = add_instance(scene, before), fresh = add_instance(scene, after);
  const nook_instance_id neighbour = add_instance(scene, before);
  const SphericalGaussian sun{{0, 1, 0}, 6, {1, 2, 3}};
  const Plane plane{{0, 1, 0}, -1};
  const auto pose = stiff_pose(before->model, {1, 2, 3}, 0.4f, 1.2f);
  for (const nook_instance_id id : {changed, fresh}) {
    set_pose(scene, id, pose);
    set_ground(scene, id, &plane);
    set_light(scene, id, {&sun, 1});
    link(scene, id, neighbour);
  }
  update(scene);
  REQUIRE(ao_of(scene, changed) != ao_of(scene, fresh));
  set_model(scene, changed, after);
  CHECK(ao_of(scene, changed) == std::vector<float>(after->model.file_to_welded.size(), 1.0f));
  update(scene);
  CHECK(ao_of(scene, changed) == ao_of(scene, fresh));
  std::vector<float> one(3 * after->model.file_to_welded.size()), other(one.size());
  read_directional_ao(scene, instance_of(scene, changed), one.data(), 12);
  read_directional_ao(scene, instance_of(scene, fresh), other.data(), 12);
  CHECK(one == other);
  CHECK(mentions(failure_of(NOOK_ERROR_INVALID_ARGUMENT,
                            [&] {
                              set_model(scene, changed, load(single_model({0, 1, 0}, 0.3f)));
                            }),
                 "bones"));
}

TEST_CASE("ids of removed instances are refused and never come back") {
  Scene scene = make_scene();
  const auto model = load(single_model({0, 1, 0}, 0.3f));
  const nook_instance_id first = add_instance(scene, model), second = add_instance(scene, model);
  link(scene, first, second);
  update(scene);
  remove_instance(scene, second);
  CHECK(instance_of(scene, first).input.linked.empty());
  update(scene);
  CHECK(scene.stats.links == 0);
  CHECK(mentions(failure_of(NOOK_ERROR_INVALID_HANDLE, [&] { remove_instance(scene, second); }),
                 "no instance"));
  // More often than a slot has generations: the slot retires and another takes its place.
  std::vector<nook_instance_id> seen{first, second};
  for (int i = 0; i < 5000; ++i) {
    const nook_instance_id id = add_instance(scene, model);
    seen.push_back(id);
    remove_instance(scene, id);
  }
  std::ranges::sort(seen);
  CHECK(std::ranges::adjacent_find(seen) == seen.end());
  CHECK(scene.instances.size() == 3);
}

TEST_CASE("links in any order of edits equal a plain table") {
  Scene scene = make_scene();
  const auto model = load(single_model({0, 1, 0}, 0.3f));
  constexpr std::uint32_t count = 12;
  std::vector<nook_instance_id> ids;
  for (std::uint32_t i = 0; i < count; ++i) ids.push_back(add_instance(scene, model));
  std::vector<std::vector<bool>> linked(count, std::vector<bool>(count, false));
  Numbers numbers(31);
  for (int edit = 0; edit < 3000; ++edit) {
    const std::uint32_t a = numbers.below(count), b = numbers.below(count);
    if (a == b) {
      // Another instance takes the slot.
      remove_instance(scene, ids[a]);
      ids[a] = add_instance(scene, model);
      for (std::uint32_t i = 0; i < count; ++i) linked[a][i] = linked[i][a] = false;
    } else if (numbers.below(3) == 0 && linked[a][b]) {
      unlink(scene, ids[a], ids[b]);
      linked[a][b] = false;
    } else {
      link(scene, ids[a], ids[b]);
      linked[a][b] = true;
    }
    for (std::uint32_t receiver = 0; receiver < count; ++receiver) {
      Slots casters;
      for (std::uint32_t caster = 0; caster < count; ++caster)
        if (linked[receiver][caster]) casters.push_back(slot_of(scene, ids[caster]));
      std::ranges::sort(casters);
      REQUIRE(instance_of(scene, ids[receiver]).input.linked == casters);
    }
  }
}

TEST_CASE("removing an instance costs the same in a scene of any size") {
  const auto model = load(single_model({0, 1, 0}, 0.3f));
  const auto seconds_of_each = [&](std::uint32_t count) {
    Scene scene = make_scene();
    std::vector<nook_instance_id> ids;
    for (std::uint32_t i = 0; i < count; ++i) {
      ids.push_back(add_instance(scene, model));
      if (i > 0) link(scene, ids[i], ids[i - 1]);
    }
    constexpr std::uint32_t removals = 500;
    const auto start = std::chrono::steady_clock::now();
    for (std::uint32_t i = 0; i < removals; ++i) remove_instance(scene, ids[i * (count / removals)]);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return taken.count() / removals;
  };
  const auto fastest_of_each = [&](std::uint32_t count) {
    double best = 1e9;
    for (int trial = 0; trial < 3; ++trial) best = std::min(best, seconds_of_each(count));
    return best;
  };
  // A visit of every instance costs at least 64 times as much in the larger scene. The memory of a removal is
  // not in the processor's caches there, which costs a factor of 12.
  CHECK(fastest_of_each(64'000) < 32 * fastest_of_each(1000));
}

TEST_CASE("distant instances take turns, none waits longer than the interval") {
  SceneSettings settings;
  settings.lod_distance = 10;
  settings.lod_max_interval = 4;
  Scene scene = make_scene(settings);
  const auto model = load(single_model({0, 1, 0}, 0.3f));
  std::vector<nook_instance_id> ids;
  for (const float x : {0.0f, 25.0f, 1000.0f, 1000.0f}) ids.push_back(place(scene, model, {x, 0, 0}));
  scene.has_camera = true;
  std::vector<int> updates(ids.size());
  for (int frame = 0; frame < 13; ++frame) {
    update(scene);
    for (std::size_t i = 0; i < ids.size(); ++i) updates[i] += instance_of(scene, ids[i]).plan.due;
  }
  // The first frame evaluates all; then 1, 25 m / 10 m -> every 2nd, beyond 40 m every 4th.
  CHECK(updates[0] == 13);
  CHECK((updates[1] == 7));
  CHECK((updates[2] == 4 && updates[3] == 4));
  CHECK(scene.stats.instances == 4);
}
