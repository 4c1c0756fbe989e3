// Whatever cannot follow poses on the GPU says so by name, and wrong poses change nothing.
#include <nook/experimental/nook_world_sample.h>

#include <algorithm>
#include <cmath>

#include "tests/gl/gpu_poses.h"
#include "tests/gl/world_scene.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("a pose that is not finite opens its instance and casts nothing") {
  NOOK_NEED_COMPUTE(context);
  for (const nook_form form : {NOOK_FORM_DEFAULT, NOOK_FORM_PAPER}) {
    CrowdOptions options;
    options.nearest = false;
    options.form = form;
    Twins twins(context, options);
    const CrowdPoses good = random_poses({}, twins.on_gpu.ids.size());
    constexpr std::size_t bad = 4;
    const nook_lobe lobe{{0, 1, 0}, 6, {1, 2, 3}, 0};
    NOOK_OK_OR_FAIL(nook_scene_set_light(twins.on_gpu.scene, twins.on_gpu.ids[bad], &lobe, 1));
    for (const float number : {NAN, INFINITY, 1e30f}) {
      INFO("form " << form << ", number " << number);
      CHECK(twins.difference(good) <= bound_of_samples);
      CrowdPoses poses = good;
      poses.numbers[(bad * 5 + 3) * 16 + 2] = number;
      // The twin has good poses, from which the bounds come, and no link to the bad one.
      NOOK_OK_OR_FAIL(
          nook_scene_unlink(twins.on_cpu.scene, twins.on_cpu.ids[bad + 1], twins.on_cpu.ids[bad]));
      Call call(context.gl(), poses);
      NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, twins.told_of(good)));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_cpu.scene));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
      for (std::size_t i = 0; i < twins.on_gpu.ids.size(); ++i) {
        const std::vector<float> ao = gpu_ao(twins.gl, twins.on_gpu, twins.model, i);
        if (i == bad)
          for (const float value : ao) CHECK(value == 1.0f);
        else
          CHECK(largest_difference(ao, gpu_ao(twins.gl, twins.on_cpu, twins.model, i)) <= bound_of_samples);
      }
      std::vector<float> rgb(3 * std::size_t(file_vertices(twins.model)));
      NOOK_OK_OR_FAIL(nook_gl_scene_read(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[bad],
                                         NOOK_CHANNEL_DIRECTIONAL_AO, rgb.data(),
                                         file_vertices(twins.model)));
      for (const float value : rgb) CHECK(value == 1.0f);
      NOOK_OK_OR_FAIL(nook_scene_link(twins.on_cpu.scene, twins.on_cpu.ids[bad + 1], twins.on_cpu.ids[bad]));
    }
    // The next pose is good again.
    CHECK(twins.difference(good) <= bound_of_samples);
  }
}

TEST_CASE("what needs bones on the CPU refuses poses on the GPU by name") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  twins.difference(poses);
  const nook_scene scene = twins.on_gpu.scene;
  const nook_instance_id id = twins.on_gpu.ids[2];
  const char* const text = "the pose of instance 1 is on the GPU";
  const char* const own = "the pose of instance 3 is on the GPU";
  CHECK(nook_scene_update(scene) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(text));
  std::vector<float> ao(file_vertices(twins.model));
  const auto count = static_cast<std::uint32_t>(ao.size());
  for (const nook_channel channel :
       {NOOK_CHANNEL_AO, NOOK_CHANNEL_DIRECTIONAL_AO, NOOK_CHANNEL_BENT_NORMAL}) {
    std::vector<float> out(4 * std::size_t(count));
    const nook_format format = channel == NOOK_CHANNEL_BENT_NORMAL ? NOOK_FORMAT_SNORM8 : NOOK_FORMAT_FLOAT;
    CHECK(nook_scene_read(scene, id, channel, format, out.data(), count, 0) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says(own));
  }
  std::uint32_t room = 0;
  CHECK(nook_scene_read_spheres(scene, id, nullptr, &room) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  CHECK(nook_scene_read_key_points(scene, id, nullptr, &room) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  std::size_t size = 0;
  CHECK(nook_scene_record_pose(scene, id, nullptr, &size) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  CHECK(nook_scene_set_model(scene, id, twins.model) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  nook_pose_desc desc = pose_of(poses, 2);
  desc.flags = NOOK_POSE_FLAG_PARTIAL;
  CHECK(nook_scene_set_pose(scene, id, &desc) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(own));
  nook_world_sample_desc sample;
  NOOK_OK_OR_FAIL(nook_world_sample_desc_init(&sample));
  const float point[3] = {0, 0, 0}, normal[3] = {0, 1, 0};
  sample.positions = point;
  sample.normals = normal;
  sample.point_count = 1;
  CHECK(nook_world_sample(scene, &sample, ao.data(), nullptr) == NOOK_ERROR_UNSUPPORTED);
  CHECK(says(text));
  // These know all that they tell.
  nook_scene_instance_info info{};
  info.struct_size = sizeof info;
  CHECK(nook_scene_describe_instance(scene, id, &info) == NOOK_OK);
  CHECK(nook_scene_read_links(scene, id, nullptr, &room) == NOOK_OK);
  // An instance that is gone does not count.
  for (const nook_instance_id gone : twins.on_gpu.ids)
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(scene, gone));
  CHECK(nook_scene_update(scene) == NOOK_OK);
}

TEST_CASE("wrong poses are refused by name, and change nothing") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses good = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(good) <= bound_of_samples);
  const CrowdPoses moved = random_poses({}, good.places.size(), {0, 1, 0});
  const std::vector<nook_gl_instance_pose> instances = twins.told_of(good);
  const auto refused = [&](const char* text, nook_result code, const auto& change) {
    INFO(text);
    Call call(context.gl(), moved);
    std::vector<nook_gl_instance_pose> some = instances;
    change(call, some);
    CHECK(call(twins.gl, twins.on_gpu, some) == code);
    INFO(nook_last_message());
    CHECK(says(text));
  };
  constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;
  using Some = std::vector<nook_gl_instance_pose>;
  refused("poses.struct_size", invalid, [](Call& c, Some&) { c.poses.struct_size = 8; });
  refused("poses.format", invalid, [](Call& c, Some&) { c.poses.format = NOOK_FORMAT_UNORM8; });
  refused("cannot read transforms from a texture", NOOK_ERROR_UNSUPPORTED,
          [](Call& c, Some&) { c.poses.texture = 1; });
  refused("poses.buffer is 0", invalid, [](Call& c, Some&) { c.poses.buffer = 0; });
  refused("multiples of 4", invalid, [](Call& c, Some&) { c.poses.offset = 2; });
  refused("multiples of 4", invalid, [](Call& c, Some&) { c.poses.size = 0; });
  refused("instances[8]", invalid, [](Call& c, Some&) { c.poses.size -= 4 * 32; });
  refused("instances[1]", invalid, [](Call&, Some& s) { s[1].first_transform = UINT32_MAX; });
  refused("NOOK_POSE_FLAG_STRICT", invalid, [](Call& c, Some&) { c.desc.flags = NOOK_POSE_FLAG_STRICT; });
  refused("poses.pose->stride", invalid, [](Call& c, Some&) { c.desc.stride = 60; });
  refused("poses.pose->stride", invalid, [](Call& c, Some&) { c.desc.stride = 66; });
  refused("transform_count", invalid, [](Call& c, Some&) { c.desc.transform_count = 4; });
  refused("desc.skin", invalid, [](Call& c, Some&) { c.desc.skin = 2; });
  const float zero[16] = {};
  refused("transforms is not NULL", invalid, [&](Call& c, Some&) { c.desc.transforms = zero; });
  const float place[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  refused("place_3x4 is not NULL", invalid, [&](Call& c, Some&) { c.desc.place_3x4 = place; });
  refused("occurs twice", invalid, [](Call&, Some& s) { s[3].instance = s[7].instance; });
  refused("instance 12345", NOOK_ERROR_INVALID_HANDLE, [](Call&, Some& s) { s[3].instance = 12345; });
  refused("the sphere of instances[3]", invalid, [](Call&, Some& s) { s[3].bound_centre_ws[1] = NAN; });
  refused("the sphere of instances[3]", invalid, [](Call&, Some& s) { s[3].bound_radius = -1; });
  refused("instances[3].scale", invalid, [](Call&, Some& s) { s[3].scale = NAN; });
  refused("instances[3].place_3x4", invalid, [](Call&, Some& s) { s[3].place_3x4[5] = INFINITY; });
  CHECK(twins.difference() <= bound_of_samples);
  float bones[60];
  CHECK(nook_gl_scene_read_pose(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[0], bones, 4) == invalid);
  CHECK(nook_gl_scene_read_pose(twins.gl, twins.on_cpu.scene, twins.on_cpu.ids[0], bones, 5) ==
        NOOK_ERROR_INVALID_HANDLE);

  // A second model in one call.
  nook_model other = load_model(twins.host.handle, sample_model(32));
  nook_instance_id stranger = 0;
  NOOK_OK_OR_FAIL(nook_scene_add_instance(twins.on_gpu.scene, other, &stranger));
  refused("another model", invalid, [&](Call&, Some& s) { s[3].instance = stranger; });
  nook_model_destroy(&other);
  CHECK(context.gl().GetError() == GL_NO_ERROR);
}

TEST_CASE("a nook_gl without the poses asks for them, and gets them again") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(poses) <= bound_of_samples);
  const auto is_missing = [&](nook_gl gl) {
    const nook_result result = nook_gl_scene_update(gl, twins.on_gpu.scene);
    return result == NOOK_ERROR_INVALID_HANDLE && says("call nook_gl_scene_set_poses with this nook_gl");
  };
  SECTION("another nook_gl") {
    nook_gl other = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
    CHECK(is_missing(other));
    nook_gl_destroy(&other);
  }
  SECTION("a release") {
    NOOK_OK_OR_FAIL(nook_gl_scene_release(twins.gl, twins.on_gpu.scene));
    CHECK(is_missing(twins.gl));
  }
  SECTION("a lost context") {
    Call call(context.gl(), poses);
    context.clear_current();
    NOOK_OK_OR_FAIL(nook_gl_context_lost(twins.gl));
    CHECK(call(twins.gl, twins.on_gpu, twins.told_of(poses)) == NOOK_ERROR_GL);
    nook_gl_destroy(&twins.gl);
    context.make_current();
    twins.gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
    CHECK(is_missing(twins.gl));
  }
  SECTION("a tier without compute shaders") {
    const int below = is_es(context.gl()) ? NOOK_GL_TIER_ES30 : NOOK_GL_TIER_33;
    nook_gl other = create_gl(twins.host.handle, platform::Context::loader, &context, below);
    CHECK(nook_gl_scene_update(other, twins.on_gpu.scene) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says("is on the GPU"));
    nook_gl_destroy(&other);
  }
  CHECK(twins.difference(poses) <= bound_of_samples);
}

TEST_CASE("tiers without compute shaders refuse poses on the GPU by name") {
  NOOK_NEED_CONTEXT(context);
  for (const int tier : tiers_of(context)) {
    if (computes(tier)) continue;
    CountedContext host;
    nook_model model = load_model(host.handle, sample_model(33));
    Crowd crowd(host.handle, {model}, {5}, {});
    nook_gl gl = create_gl(host.handle, platform::Context::loader, &context, tier);
    Transforms transforms;
    transforms.kind = NOOK_POSE_REST_TO_WORLD;
    const CrowdPoses poses = random_poses(transforms, crowd.ids.size());
    nook_gl_instance_pose one{};
    one.instance = crowd.ids[0];
    one.bound_radius = one.scale = 1;
    Call call(context.gl(), poses);
    CHECK(call(gl, crowd, {one}) == NOOK_ERROR_UNSUPPORTED);
    CHECK(says("play baked clips"));
    float bones[60];
    CHECK(nook_gl_scene_read_pose(gl, crowd.scene, crowd.ids[0], bones, 5) == NOOK_ERROR_UNSUPPORTED);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    nook_gl_destroy(&gl);
    nook_model_destroy(&model);
  }
}

TEST_CASE("a debug context refuses a range beyond the buffer") {
  NOOK_NEED_COMPUTE(context);
  Twins twins(context);
  nook_gl_desc desc;
  NOOK_OK_OR_FAIL(nook_gl_desc_init(&desc));
  desc.get_proc = platform::Context::loader;
  desc.get_proc_user = &context;
  desc.debug = 1;
  nook_gl gl = nullptr;
  NOOK_OK_OR_FAIL(nook_gl_create(twins.host.handle, &desc, &gl));
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  Call call(context.gl(), poses);
  call.poses.offset = 4;
  const auto instances = twins.told_of(poses);
  CHECK(call(gl, twins.on_gpu, instances) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(says("is too small"));
  call.poses.offset = 0;
  CHECK(call(gl, twins.on_gpu, instances) == NOOK_OK);
  nook_gl_destroy(&gl);
  take_debug_messages();
}

TEST_CASE("the world pass leaves out poses on the GPU and says so once") {
  NOOK_NEED_COMPUTE(context);
  using namespace nook::test::world;
  WorldFixture fixture(context);
  nook_world pass = fixture.made();
  Numbers numbers(4);
  CharacterModel made = sample_model();
  add_world_casters(made, numbers);
  nook_model model = load_model(fixture.host.handle, made);
  {
    CrowdOptions options;
    options.instances = 2;
    options.occluders = false;
    Crowd crowd(fixture.host.handle, {model}, {5}, options);
    const Camera camera = plain_camera(float(width) / height);
    const Picture picture = look(camera, still_life(), width, height);
    const View view = turned_view();
    const ScreenFrame screen =
        frame_desc(camera, width, height, fixture.depth_of(camera, picture), fixture.normals_of(picture), 1);
    DarkenedFrame frame = world_frame(screen, view);
    frame.scene = crowd.scene;
    const auto casters = [&] {
      NOOK_OK_OR_FAIL(nook_world_render(pass, &frame, &frame));
      nook_world_info info{};
      info.struct_size = sizeof info;
      NOOK_OK_OR_FAIL(nook_world_describe(pass, &info));
      return info.group_count;
    };
    const auto told_times = [&] {
      return std::count_if(fixture.host.log.begin(), fixture.host.log.end(), [](const std::string& line) {
        return line.find("1 instances have poses on the GPU") != std::string::npos;
      });
    };
    // Both bodies stand before the camera.
    Transforms transforms;
    transforms.kind = NOOK_POSE_REST_TO_WORLD;
    CrowdPoses poses = random_poses(transforms, 2);
    for (auto& place : poses.places) {
      const Vec3 at = view.to_world({0, 0, -2.5f});
      place[3] = at.x;
      place[7] = at.y;
      place[11] = at.z;
    }
    pose_on_cpu(crowd, poses);
    CHECK(casters() == 2);
    CHECK(told_times() == 0);
    Call call(context.gl(), poses);
    std::vector<nook_gl_instance_pose> one = told(crowd, crowd, model, poses);
    one.resize(1);
    NOOK_OK_OR_FAIL(call(fixture.gl, crowd, one));
    CHECK(casters() == 1);
    CHECK(casters() == 1);
    CHECK(told_times() == 1);
    // With a pose on the CPU it darkens again.
    pose_on_cpu(crowd, poses);
    CHECK(casters() == 2);
  }
  nook_model_destroy(&model);
}
