// Poses on the GPU from frame to frame: Nook keeps the last ones, waits for nothing, allocates nothing and
// keeps OpenGL's state, and a call that fails leaves the poses as they were.
#include <algorithm>
#include <functional>

#include "tests/gl/gpu_poses.h"
#include "tests/gl/poison.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

TEST_CASE("instances that are not in a call keep their last pose, and turns of update too") {
  NOOK_NEED_COMPUTE(context);
  CrowdOptions options;
  options.camera = true;
  options.lod_max_interval = 3;
  Twins twins(context, options);
  const std::size_t count = twins.on_gpu.ids.size();
  CHECK(twins.difference(random_poses({}, count)) <= bound_of_samples);
  for (std::size_t first = 0; first < count; first += 2) {
    INFO("instances from " << first << " on");
    CrowdPoses poses = random_poses({}, count, {0, 0, 0.1f * static_cast<float>(first + 1)});
    std::reverse(poses.places.begin(), poses.places.begin() + 2);
    for (std::size_t i = first; i < std::min(first + 2, count); ++i) {
      const nook_pose_desc desc = pose_of(poses, i);
      NOOK_OK_OR_FAIL(nook_scene_set_pose(twins.on_cpu.scene, twins.on_cpu.ids[i], &desc));
    }
    std::vector<nook_gl_instance_pose> some = twins.told_of(poses);
    some.erase(some.begin() + static_cast<long>(std::min(first + 2, count)), some.end());
    some.erase(some.begin(), some.begin() + static_cast<long>(first));
    Call call(context.gl(), poses);
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, some));
    CHECK(twins.difference() <= bound_of_samples);
  }
  // One goes back to the CPU, and comes again.
  pose_on_cpu(twins.on_gpu, random_poses({}, count, {1, 0, 0}));
  pose_on_cpu(twins.on_cpu, random_poses({}, count, {1, 0, 0}));
  CHECK(twins.difference() <= bound_of_samples);
  for (const Crowd* crowd : {&twins.on_gpu, &twins.on_cpu}) NOOK_OK_OR_FAIL(nook_scene_update(crowd->scene));
  CHECK(twins.difference(random_poses({}, count)) <= bound_of_samples);
}

TEST_CASE("poses on the GPU allocate nothing in a frame, wait for nothing and query only to preserve") {
  NOOK_NEED_COMPUTE(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Trace trace(context);
    Twins twins(context, {}, Trace::loader, &trace, mode);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const auto instances = twins.told_of(poses);
    Call call(context.gl(), poses);
    NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    trace.reset();
    const long allocations = twins.host.allocations;
    for (int frame = 0; frame < 3; ++frame) {
      NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    }
    CHECK(twins.host.allocations == allocations);
    CHECK(trace.calls("glDispatchCompute") > 0);
    CHECK(trace.forbidden_in_frame(mode == NOOK_GL_STATE_PRESERVE) == std::set<std::string>());
  }
}

TEST_CASE("poses on the GPU keep the state contract") {
  NOOK_NEED_COMPUTE(context);
  const unsigned users = users_of_tier(tiers_of(context).front());
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Twins twins(context, {}, platform::Context::loader, &context, mode);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const auto instances = twins.told_of(poses);
    Call call(context.gl(), poses);
    float bones[60];
    const std::function<void()> steps[] = {
        [&] { NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances)); },  // makes programs and buffers
        [&] { NOOK_OK_OR_FAIL(call(twins.gl, twins.on_gpu, instances)); },
        [&] { NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene)); },
        [&] {
          NOOK_OK_OR_FAIL(
              nook_gl_scene_read_pose(twins.gl, twins.on_gpu.scene, twins.on_gpu.ids[0], bones, 5));
        }};
    for (std::size_t i = 0; i < std::size(steps); ++i) {
      INFO("step " << i);
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      steps[i]();
      if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
      if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
      CHECK(poison.untouched() == untouched);
    }
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    CHECK(twins.difference() <= bound_of_samples);
  }
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("every refused allocation of poses on the GPU gives an error and leaves everything usable") {
  NOOK_NEED_COMPUTE(context);
  int refusals = 0;
  for (long n = 0;; ++n) {
    INFO("allocation " << n);
    Twins twins(context);
    const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
    pose_on_cpu(twins.on_cpu, poses);
    const auto instances = twins.told_of(poses);
    Call call(context.gl(), poses);
    twins.host.refuse_after = n;
    const nook_result result = call(twins.gl, twins.on_gpu, instances);
    twins.host.refuse_after = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    REQUIRE(result == NOOK_ERROR_OUT_OF_MEMORY);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(twins.gl, twins.on_gpu.scene));
    CHECK(twins.difference(poses) <= bound_of_samples);
  }
  CHECK(refusals >= 3);
}

TEST_CASE("a map that fails leaves the poses as they were") {
  NOOK_NEED_COMPUTE(context);
  Trace trace(context);
  Twins twins(context, {}, Trace::loader, &trace);
  const CrowdPoses poses = random_poses({}, twins.on_gpu.ids.size());
  CHECK(twins.difference(poses) <= bound_of_samples);
  const CrowdPoses later = random_poses({}, twins.on_gpu.ids.size(), {0, 2, 0});
  const auto instances = twins.told_of(later);
  Call call(context.gl(), later);
  trace.mapping_fails = true;
  CHECK(call(twins.gl, twins.on_gpu, instances) == NOOK_ERROR_GL);
  trace.mapping_fails = false;
  CHECK(twins.difference() <= bound_of_samples);
  // Contents that OpenGL loses once are written again.
  trace.unmapping_failures = 1;
  CHECK(twins.difference(later) <= bound_of_samples);
}
