// The pool of a scene: near instances have the AO of a scene without a pool, to the bit, and far ones have
// AO 1.
#include <algorithm>

#include "tests/gl/poison.h"
#include "tests/gl/pooled_crowd.h"
#include "tests/gl/traced_loader.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("near instances of a pool have the AO of a scene without one, to the bit") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  for (const std::uint32_t nearest : {0u, 3u}) {
    INFO("nearest " << nearest);
    PoolOptions options;
    options.nearest = nearest;
    const PooledCrowd plain(stage, 16, options);
    options.places = 8;
    const PooledCrowd pooled(stage, 16, options);
    for (std::size_t frame = 0; frame < 4; ++frame) {
      const auto x = two_groups(16, frame);
      for (const PooledCrowd* crowd : {&plain, &pooled}) {
        crowd->play(x, 0.1 * double(frame));
        crowd->update();
      }
      CHECK(pooled.info().near_count == 8);
      CHECK(pooled.info().waiting_count == 0);
      const auto near = pooled.near();
      CHECK_FALSE(
          std::all_of(near.begin(), near.end(), [&](std::size_t i) { return is_open(pooled.ao(i)); }));
      check_same(pooled, plain);
    }
  }
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("a full pool serves the nearest instances and counts the others") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  PoolOptions options;
  const PooledCrowd plain(stage, 6, options);
  options.places = 3;
  const PooledCrowd pooled(stage, 6, options);
  const auto play = [&](const std::vector<float>& x) {
    for (const PooledCrowd* crowd : {&plain, &pooled}) {
      crowd->play(x, 0.3);
      crowd->update();
    }
    check_same(pooled, plain);
  };
  using Near = std::vector<std::size_t>;
  play({8, 6, 4, 3, 2, 50});
  CHECK(pooled.near() == Near{2, 3, 4});
  CHECK(pooled.info().near_count == 3);
  CHECK(pooled.info().waiting_count == 2);
  // An instance that is a little nearer does not push another one out of its place; a much nearer one does.
  play({8, 3.9f, 4, 3, 2, 50});
  CHECK(pooled.near() == Near{2, 3, 4});
  play({8, 3, 4, 3, 2, 50});
  CHECK(pooled.near() == Near{1, 3, 4});
  // A place stays taken a little beyond the distance.
  play({50, 10.5f, 50, 10.5f, 2, 50});
  CHECK(pooled.near() == Near{1, 3, 4});
  play({50, 11.5f, 50, 11.5f, 2, 10.5f});
  CHECK(pooled.near() == Near{4});
  CHECK(pooled.info().waiting_count == 0);
  // The distance may change while the scene has instances.
  NOOK_OK_OR_FAIL(set_pool(stage.gl, pooled.scene, 3, 20));
  play({50, 11.5f, 50, 11.5f, 2, 50});
  CHECK(pooled.near() == Near{1, 3, 4});
}

TEST_CASE("instances come and go without an allocation, a wait or a query, and tell it by a generation") {
  NOOK_NEED_COMPUTE(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Trace trace(context);
    const Stage stage(context, mode, Trace::loader, &trace);
    const PooledCrowd pooled(stage, 16, {5, 10, 3});
    pooled.play(two_groups(16), 0);
    pooled.update();
    trace.reset();
    const long allocations = stage.host.allocations;
    const std::uint64_t bytes = info_of(stage.gl).buffer_bytes;
    std::vector<nook_gl_pool_view> before(16), after(16);
    const auto ask = [&](std::vector<nook_gl_pool_view>& out) {
      NOOK_OK_OR_FAIL(
          nook_gl_scene_read_pool(stage.gl, pooled.scene, pooled.ids.data(), 16, out.data(), nullptr));
    };
    ask(before);
    bool same = true;
    int changes = 0;
    std::vector<std::vector<float>> x;
    for (std::size_t frame = 0; frame < 4; ++frame) x.push_back(two_groups(16, frame));
    const auto place = [](const nook_gl_pool_view& view) { return std::pair(view.buffer, view.offset); };
    long in_play = 0;
    for (std::size_t frame = 0; frame < 200; ++frame) {
      const long now = stage.host.allocations;
      pooled.play(x[frame % 4], 0.05 * double(frame));
      in_play += stage.host.allocations - now;
      pooled.update();
      ask(after);
      for (std::size_t i = 0; i < 16; ++i) {
        const bool moved = place(before[i]) != place(after[i]);
        changes += moved;
        // Another instance may have had the place between; then the generation changes too.
        same &= !moved || before[i].generation != after[i].generation;
      }
      std::swap(before, after);
    }
    CHECK(same);
    CHECK(changes > 200);
    CHECK(in_play == 0);
    CHECK(stage.host.allocations == allocations);
    CHECK(info_of(stage.gl).buffer_bytes == bytes);
    CHECK(trace.forbidden_in_frame(mode == NOOK_GL_STATE_PRESERVE) == std::set<std::string>());
    // Views stay while nobody moves.
    pooled.update();
    ask(after);
    for (std::size_t i = 0; i < 16; ++i) CHECK(before[i].generation == after[i].generation);
  }
}

TEST_CASE("a pool keeps the state contract") {
  NOOK_NEED_COMPUTE(context);
  const unsigned users = users_of_tier(tiers_of(context).front());
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS}) {
    INFO("mode " << mode);
    const Stage stage(context, mode);
    const PooledCrowd pooled(stage, 8, {4});
    for (std::size_t step = 0; step < 3; ++step) {
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      pooled.play(two_groups(8, step), 0.1 * double(step));
      pooled.update();
      CHECK(poison.touched() == (mode == NOOK_GL_STATE_DEFAULTS ? poison.defaults() : touched));
      CHECK(poison.untouched() == untouched);
    }
    CHECK(context.gl().GetError() == GL_NO_ERROR);
  }
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("poses on the GPU take places of a pool in the call that brings them") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  // The twin without a pool tells the bounds.
  const PooledCrowd told_by(stage, 9, {}), plain(stage, 9, {}), pooled(stage, 9, {9, 2.5f});
  const CrowdPoses poses = random_poses({}, 9);
  std::vector<nook_gl_instance_pose> all(9);
  for (std::size_t i = 0; i < 9; ++i) {
    const nook_pose_desc desc = pose_of(poses, i);
    NOOK_OK_OR_FAIL(nook_scene_set_pose(told_by.scene, told_by.ids[i], &desc));
    nook_scene_instance_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_scene_describe_instance(told_by.scene, told_by.ids[i], &info));
    all[i].first_transform = poses.first_transform(i);
    std::copy_n(info.bound_centre_ws, 3, all[i].bound_centre_ws);
    all[i].bound_radius = info.bound_radius;
    all[i].scale = largest_scale(converted(stage.model, poses, i));
    std::copy_n(poses.places[i].begin(), 12, all[i].place_3x4);
  }
  const std::vector<std::uint32_t> words = poses.words(0);
  const HostBuffer buffer(context.gl(), std::as_bytes(std::span(words)));
  const auto set = [&](const PooledCrowd& crowd) {
    nook_pose_desc desc = pose_of(poses, 0);
    desc.transforms = nullptr;
    desc.place_3x4 = nullptr;
    nook_gl_poses call{};
    call.struct_size = sizeof call;
    call.pose = &desc;
    call.buffer = buffer.name();
    call.size = words.size() * sizeof(std::uint32_t);
    std::vector<nook_gl_instance_pose> some = all;
    for (std::size_t i = 0; i < some.size(); ++i) some[i].instance = crowd.ids[i];
    NOOK_OK_OR_FAIL(nook_gl_scene_set_poses(stage.gl, crowd.scene, &call, some.data(), 9));
  };
  const auto look = [&](Vec3 eye) {
    for (const PooledCrowd* crowd : {&plain, &pooled}) crowd->look_from(eye);
  };
  const auto update = [&] {
    for (const PooledCrowd* crowd : {&plain, &pooled}) crowd->update();
    check_same(pooled, plain);
  };
  set(plain);
  const auto centre = [&](std::size_t i) {
    return Vec3{all[i].bound_centre_ws[0], all[i].bound_centre_ws[1], all[i].bound_centre_ws[2]};
  };
  // Some are near each other, and some are not.
  float mean = 0;
  for (std::size_t i = 1; i < 9; ++i) mean += length(centre(i) - centre(0)) / 8;
  NOOK_OK_OR_FAIL(set_pool(stage.gl, pooled.scene, 9, mean));
  for (const std::size_t i : {0, 8, 3, 0}) {
    look(centre(i));
    set(pooled);
    update();
    CHECK(pooled.info().near_count > 1);
    CHECK(pooled.info().near_count < 9);
  }
  // Without new poses, those that come near stay far, and those that stay near keep theirs.
  const auto before = pooled.near();
  look(centre(4));
  update();
  for (const std::size_t i : pooled.near()) CHECK(std::count(before.begin(), before.end(), i) == 1);
  set(pooled);
  update();
  // After a release the poses are lost, and all are far until the next ones.
  NOOK_OK_OR_FAIL(nook_gl_scene_release(stage.gl, pooled.scene));
  update();
  CHECK(pooled.info().near_count == 0);
  set(pooled);
  update();
  CHECK(pooled.info().near_count > 1);
  // From poses on the GPU to clips and back.
  look({1, 0, 1});
  for (const PooledCrowd* crowd : {&plain, &pooled}) crowd->play(std::vector<float>(9, 1.0f), 0.4);
  update();
  CHECK(pooled.info().near_count == 9);
  look(centre(0));
  set(plain);
  set(pooled);
  update();
  CHECK(pooled.info().near_count < 9);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("instances of a pool may be posed on the CPU, added, removed and left without a pose") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  PooledCrowd plain(stage, 6, {}), pooled(stage, 6, {3});
  pooled.update();
  CHECK(pooled.info().near_count == 0);  // nobody has a pose
  CHECK(is_open(pooled.ao(0)));
  const auto play = [&](const std::vector<float>& x) {
    for (PooledCrowd* crowd : {&plain, &pooled}) {
      crowd->play(x, 0.3);
      Numbers numbers(5);
      const std::vector<Mat3x4> bones = random_pose(numbers, stage.bones, {1, 0, 0});
      nook_pose_desc desc;
      NOOK_OK_OR_FAIL(nook_pose_desc_init(&desc));
      desc.kind = NOOK_POSE_REST_TO_WORLD;
      desc.layout = NOOK_TRANSFORM_ROWS_3X4;
      desc.transforms = bones.data()->m;
      desc.transform_count = stage.bones;
      NOOK_OK_OR_FAIL(nook_scene_set_pose(crowd->scene, crowd->ids[0], &desc));
      crowd->update();
    }
    check_same(pooled, plain);
  };
  play({0, 1, 2, 50, 50, 50});
  CHECK(pooled.near() == std::vector<std::size_t>{0, 1, 2});
  // The bones that the host set are there to read.
  std::uint32_t count = 0;
  NOOK_OK_OR_FAIL(nook_scene_read_key_points(pooled.scene, pooled.ids[0], nullptr, &count));
  CHECK(nook_scene_read_key_points(pooled.scene, pooled.ids[1], nullptr, &count) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says("instance"));
  // A near one goes for good, and new ones come.
  for (PooledCrowd* crowd : {&plain, &pooled}) {
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd->scene, crowd->ids[1]));
    crowd->ids.erase(crowd->ids.begin() + 1);
    for (int i = 0; i < 3; ++i) crowd->add();
  }
  play({0, 2, 50, 50, 50, 50, 3, 50});
  CHECK(pooled.near() == std::vector<std::size_t>{0, 1, 6});
  // Another nook_gl, and this one again.
  nook_gl other = create_gl(stage.host.handle, platform::Context::loader, &context, 0);
  NOOK_OK_OR_FAIL(nook_gl_scene_update(other, pooled.scene));
  nook_gl_destroy(&other);
  play({0, 50, 2, 50, 50, 50, 3, 50});
  CHECK(pooled.near() == std::vector<std::size_t>{0, 2, 6});
  // Two scenes share a model's buffers: one leaves.
  nook_scene_destroy(&plain.scene);
  pooled.update();
  CHECK(pooled.near() == std::vector<std::size_t>{0, 2, 6});
}

TEST_CASE("a far instance of a pool does not darken the world, also with bones on the CPU") {
  NOOK_NEED_COMPUTE(context);
  using namespace nook::test::world;
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  Numbers numbers(4);
  CharacterModel body = sample_model();
  add_world_casters(body, numbers);
  nook_model model = load_model(fixture.host.handle, body);
  nook_scene_desc scene_desc;
  NOOK_OK_OR_FAIL(nook_scene_desc_init(&scene_desc));
  nook_scene scene = nullptr;
  NOOK_OK_OR_FAIL(nook_scene_create(fixture.host.handle, &scene_desc, &scene));
  NOOK_OK_OR_FAIL(set_pool(fixture.gl, scene, 1, 10));
  nook_instance_id id = 0;
  NOOK_OK_OR_FAIL(nook_scene_add_instance(scene, model, &id));
  const Camera camera = plain_camera(float(width) / height);
  const Picture picture = look(camera, still_life(), width, height);
  const View view = turned_view();
  const ScreenFrame screen =
      frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
  DarkenedFrame frame = world_frame(screen, view);
  frame.scene = scene;
  const Vec3 at = view.to_world({0, 0, -2.5f});
  const std::vector<Mat3x4> bones(body.bone_count(), Mat3x4{{1, 0, 0, at.x, 0, 1, 0, at.y, 0, 0, 1, at.z}});
  nook_pose_desc desc;
  NOOK_OK_OR_FAIL(nook_pose_desc_init(&desc));
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transforms = bones.data()->m;
  desc.transform_count = static_cast<std::uint32_t>(bones.size());
  NOOK_OK_OR_FAIL(nook_scene_set_pose(scene, id, &desc));
  const auto casters = [&](float aside) {
    const float eye[3] = {at.x + aside, at.y, at.z};
    NOOK_OK_OR_FAIL(nook_scene_set_camera(scene, eye));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(fixture.gl, scene));
    NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
    nook_world_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
    return info.group_count;
  };
  CHECK(casters(5) == 1);
  CHECK(casters(50) == 0);
  CHECK(casters(5) == 1);
  nook_scene_destroy(&scene);
  nook_model_destroy(&model);
}

TEST_CASE("a far instance of a pool tells by a generation that another model gave it another view") {
  NOOK_NEED_COMPUTE(context);
  const Stage stage(context);
  nook_model other = load_model(stage.host.handle, sample_model(32));
  {
    const PooledCrowd pooled(stage, 2, {2});
    pooled.play({0, 0}, 0.1);
    // The bones of the second one are on the CPU, far from the camera.
    const std::vector<Mat3x4> bones(stage.bones, Mat3x4{{1, 0, 0, 50, 0, 1, 0, 0, 0, 0, 1, 0}});
    nook_pose_desc desc;
    NOOK_OK_OR_FAIL(nook_pose_desc_init(&desc));
    desc.kind = NOOK_POSE_REST_TO_WORLD;
    desc.layout = NOOK_TRANSFORM_ROWS_3X4;
    desc.transforms = bones.data()->m;
    desc.transform_count = stage.bones;
    NOOK_OK_OR_FAIL(nook_scene_set_pose(pooled.scene, pooled.ids[1], &desc));
    pooled.update();
    CHECK(pooled.near() == std::vector<std::size_t>{0});
    const auto before = pooled.views();
    NOOK_OK_OR_FAIL(nook_scene_set_model(pooled.scene, pooled.ids[1], other));
    pooled.update();
    const auto after = pooled.views();
    CHECK(after[0].generation == before[0].generation);
    CHECK(after[1].is_near == 0);
    CHECK(after[1].buffer != before[1].buffer);
    CHECK(after[1].generation != before[1].generation);
  }
  nook_model_destroy(&other);
}
