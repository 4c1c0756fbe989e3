// The clips of a crowd in one call: on every tier the AO is the one of nook_scene_set_clip, although the CPU
// decodes no bone where compute shaders do.
#include <nook/experimental/nook_clip_crowds.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <span>
#include <utility>

#include "platform/file_bytes.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/model_file.h"
#include "tests/character/clip_sample.h"
#include "tests/gl/gpu_poses.h"
#include "tests/gl/poison.h"
#include "tests/gl/traced_loader.h"

using namespace nook;
using namespace nook::test;

namespace {

// The sample's clips, in which the bones of a body turn a little about their middle, as much as between
// frames of real clips.
ClipSet swaying_clips(const CharacterModel& model) {
  ClipSample sample = sample_clips(model);
  Numbers numbers(3);
  for (BoneSpan& bone : sample.set.bones) bone = {model.bounding_centre + numbers.place(0.5f), 0.3f};
  for (std::size_t f = 0; f < sample.poses.size(); ++f)
    for (std::size_t b = 0; b < sample.set.bones.size(); ++b) {
      const float angle = 0.15f * std::sin(0.7f * float(f) + float(b)), c = std::cos(angle),
                  s = std::sin(angle);
      const Vec3 from = sample.set.bones[b].centre, to = from + Vec3{0.02f * float(f), 0.03f * s, 0};
      sample.poses[f][b] = {{c, 0, s, to.x - c * from.x - s * from.z, 0, 1, 0, to.y - from.y, -s, 0, c,
                             to.z + s * from.x - c * from.z}};
    }
  plant_poses(sample);
  return std::move(sample.set);
}

nook_clips load_clips(nook_context context, nook_model model, const ClipSet& set) {
  const std::vector<std::byte> bytes = write_clip_set(set);
  nook_clips clips = nullptr;
  NOOK_OK_OR_FAIL(nook_clips_load(context, model, bytes.data(), bytes.size(), &clips));
  return clips;
}

// Twins of one model: in one scene each instance gets its clip by itself, in the other one call sets all.
struct ClipTwins {
  ClipTwins(const CharacterModel& character, const ClipSet& set, const CrowdOptions& options)
      : bones(static_cast<std::uint32_t>(character.bone_count())),
        model(load_model(host.handle, character)),
        clips(load_clips(host.handle, model, set)),
        alone(host.handle, {model}, {bones}, options),
        crowd(host.handle, {model}, {bones}, options) {}
  ~ClipTwins() {
    nook_clips_destroy(&clips);
    nook_model_destroy(&model);
  }
  ClipTwins(const ClipTwins&) = delete;
  ClipTwins& operator=(const ClipTwins&) = delete;

  // Places that turn, scale and, for some, mirror.
  std::vector<nook_instance_clip> playing(std::uint32_t clip, double seconds, double step) const {
    std::vector<nook_instance_clip> out;
    for (std::size_t i = 0; i < crowd.ids.size(); ++i) {
      const float x = 2.2f * float(i % 3) + 5, z = 2.2f * float(i / 3) + 5, s = 1 + 0.1f * float(i % 2);
      out.push_back({crowd.ids[i],
                     0,
                     {clip, NOOK_CLIP_LOOP, seconds + step * double(i)},
                     {0, 0, i % 4 == 3 ? -s : s, x, 0, s, 0, 0, -s, 0, 0, z}});
    }
    return out;
  }
  void set_alone(const std::vector<nook_instance_clip>& all) const {
    for (std::size_t i = 0; i < all.size(); ++i)
      NOOK_OK_OR_FAIL(nook_scene_set_clip(alone.scene, alone.ids[i], clips, &all[i].time, all[i].place_3x4));
  }
  nook_result set_crowd(const std::vector<nook_instance_clip>& all) const {
    return nook_scene_set_clips(crowd.scene, clips, all.data(), static_cast<std::uint32_t>(all.size()));
  }

  // The difference of AO after both got the clips and an update.
  Error difference(nook_gl gl) const {
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, alone.scene));
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, crowd.scene));
    Error out;
    for (std::size_t i = 0; i < crowd.ids.size(); ++i)
      out.add(gpu_ao(gl, alone, model, i), gpu_ao(gl, crowd, model, i));
    return out;
  }
  Error difference(nook_gl gl, const std::vector<nook_instance_clip>& all) const {
    set_alone(all);
    NOOK_OK_OR_FAIL(set_crowd(all));
    return difference(gl);
  }

  CountedContext host;
  std::uint32_t bones;
  nook_model model;
  nook_clips clips;
  Crowd alone, crowd;
};

CharacterModel mannequin() {
  const std::vector<unsigned char> bytes = platform::read_file(NOOK_MANNEQUIN);
  return read_character_model({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()});
}

struct SampleTwins : ClipTwins {
  explicit SampleTwins(const CrowdOptions& options = {})
      : ClipTwins(sample_model(31), sample_clips(sample_model(31)).set, options) {}
};

}  // namespace

TEST_CASE("clips of a crowd give a body the AO of nook_scene_set_clip, on every tier") {
  NOOK_NEED_CONTEXT(context);
  const CharacterModel body = mannequin();
  const ClipTwins twins(body, swaying_clips(body), {});
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, tier);
    for (const double step : {0.5, 0.2}) {
      // All instances are in frames first, then between frames.
      const Error between = twins.difference(gl, twins.playing(1, 0.5, step));
      std::printf("clips of a crowd, tier %d, %s: AO differs by %.1e at most, %.1e rms\n", tier,
                  step > 0.4 ? "frames" : "between frames", double(between.largest), between.rms());
      // The ground's sphere is 11,000 times as large as the body, so the bound of the scale between two
      // frames, which is 0.1 % larger, moves its horizon by 1e-5 of a hemisphere.
      CHECK(between.rms() <= 1e-5);
      CHECK(between.largest <= 1e-4f);
    }
    nook_gl_destroy(&gl);
  }
  CHECK(context.gl().GetError() == GL_NO_ERROR);
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("clips of a crowd agree for random bones, with mixes that need the general projection") {
  NOOK_NEED_CONTEXT(context);
  CrowdOptions options;
  options.ground = false;  // its sphere follows the scale of the bones, which is not the same between frames
  const SampleTwins twins(options);
  for (const int tier : tiers_of(context)) {
    INFO("tier " << tier);
    nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, tier);
    for (const double step : {0.0, 0.5, 0.13}) {
      const Error difference = twins.difference(gl, twins.playing(1, 0, step));
      CAPTURE(step, difference.largest, difference.rms());
      CHECK(difference.largest <= bound_of_samples);
    }
    nook_gl_destroy(&gl);
  }
}

TEST_CASE("whatever needs the bones of a crowd's clips on the CPU gets them") {
  NOOK_NEED_CONTEXT(context);
  const SampleTwins twins;
  nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  const auto all = twins.playing(1, 0, 0.5);
  const auto points = [&](const Crowd& crowd) {
    std::uint32_t count = 0;
    NOOK_OK_OR_FAIL(nook_scene_read_key_points(crowd.scene, crowd.ids[2], nullptr, &count));
    std::vector<nook_scene_key_point> out(count);
    NOOK_OK_OR_FAIL(nook_scene_read_key_points(crowd.scene, crowd.ids[2], out.data(), &count));
    std::vector<float> places;
    for (const nook_scene_key_point& point : out)
      places.insert(places.end(), point.position_ws, point.position_ws + 3);
    return places;
  };
  CHECK(twins.difference(gl, all).largest <= bound_of_samples);
  CHECK(points(twins.crowd) == points(twins.alone));
  // Bones that were decoded on the CPU also serve the GPU.
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  // An update on the CPU between those on the GPU.
  NOOK_OK_OR_FAIL(twins.set_crowd(all));
  CHECK(cpu_ao(twins.crowd, twins.model, 4) == cpu_ao(twins.alone, twins.model, 4));
  CHECK(twins.difference(gl, twins.playing(1, 0.5, 0.5)).largest <= bound_of_samples);
  nook_gl_destroy(&gl);
}

TEST_CASE("a crowd mixes clips of several files, bones and removed instances") {
  NOOK_NEED_CONTEXT(context);
  SampleTwins twins;
  nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  const auto all = twins.playing(1, 0.5, 0.5);
  twins.set_alone(all);
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.alone.scene));
  NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
  const std::uint64_t bytes_without = info_of(gl).buffer_bytes;
  // The second file has other poses, so that a wrong table would show.
  nook_clips second = load_clips(twins.host.handle, twins.model, sample_clips(sample_model(31), 7).set);
  std::vector<nook_instance_clip> odd, even;
  for (std::size_t i = 0; i < all.size(); ++i) (i % 2 ? odd : even).push_back(all[i]);
  NOOK_OK_OR_FAIL(
      nook_scene_set_clips(twins.crowd.scene, second, odd.data(), static_cast<std::uint32_t>(odd.size())));
  NOOK_OK_OR_FAIL(twins.set_crowd(even));
  for (std::size_t i = 1; i < all.size(); i += 2)
    NOOK_OK_OR_FAIL(
        nook_scene_set_clip(twins.alone.scene, twins.alone.ids[i], second, &all[i].time, all[i].place_3x4));
  // One of each kind gets bones of its own, which end the clip.
  for (const std::size_t i : {std::size_t{2}, std::size_t{3}}) {
    twins.alone.pose_one(i, 4);
    twins.crowd.pose_one(i, 4);
  }
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  nook_clips_destroy(&second);
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  const auto remove_last = [](Crowd& crowd) {
    NOOK_OK_OR_FAIL(nook_scene_remove_instance(crowd.scene, crowd.ids.back()));
    crowd.ids.pop_back();
  };
  remove_last(twins.crowd);
  remove_last(twins.alone);
  const std::uint64_t bytes_with = info_of(gl).buffer_bytes;
  CHECK(twins.difference(gl, twins.playing(1, 0, 0)).largest <= bound_of_samples);
  if (computes(info_of(gl).tier)) {
    // One table is left; without clips there is none.
    CHECK(info_of(gl).buffer_bytes < bytes_with);
    for (std::size_t i = 0; i < twins.crowd.ids.size(); ++i) twins.crowd.pose_one(i, 1);
    const nook_instance_clip one = twins.playing(1, 0, 0)[0];
    NOOK_OK_OR_FAIL(twins.set_crowd({one}));
    twins.crowd.pose_one(0, 1);
    remove_last(twins.crowd);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
    CHECK(info_of(gl).buffer_bytes <= bytes_without);
  }
  nook_gl_destroy(&gl);
}

TEST_CASE("clips of a crowd survive another nook_gl, a release and a lost context") {
  NOOK_NEED_CONTEXT(context);
  const SampleTwins twins;
  nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  CHECK(twins.difference(gl, twins.playing(1, 0, 0.5)).largest <= bound_of_samples);
  nook_gl other = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  CHECK(twins.difference(other).largest <= bound_of_samples);
  nook_gl_destroy(&other);
  NOOK_OK_OR_FAIL(nook_gl_scene_release(gl, twins.crowd.scene));
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  context.clear_current();
  NOOK_OK_OR_FAIL(nook_gl_context_lost(gl));
  NOOK_OK_OR_FAIL(twins.set_crowd(twins.playing(1, 0, 0.5)));
  nook_gl_destroy(&gl);
  context.make_current();
  gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  nook_gl_destroy(&gl);
}

TEST_CASE("poses that leave bones out keep those of a crowd's clips, on the CPU and on the GPU") {
  NOOK_NEED_CONTEXT(context);
  const SampleTwins twins;
  nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  const auto all = twins.playing(1, 0, 0.5);
  NOOK_OK_OR_FAIL(twins.set_crowd(all));
  twins.set_alone(all);
  // One bone moves, and the others keep what the clip gave them.
  const float rows[12] = {1, 0, 0, 5, 0, 1, 0, 0.2f, 0, 0, 1, 5};
  const std::int32_t only_first[5] = {0, -1, -1, -1, -1};
  nook_pose_desc desc;
  NOOK_OK_OR_FAIL(nook_pose_desc_init(&desc));
  desc.kind = NOOK_POSE_REST_TO_WORLD;
  desc.layout = NOOK_TRANSFORM_ROWS_3X4;
  desc.transform_count = 1;
  desc.transform_of_bone = only_first;
  desc.bone_count = 5;
  desc.flags = NOOK_POSE_FLAG_PARTIAL;
  desc.transforms = rows;
  NOOK_OK_OR_FAIL(nook_scene_set_pose(twins.crowd.scene, twins.crowd.ids[1], &desc));
  NOOK_OK_OR_FAIL(nook_scene_set_pose(twins.alone.scene, twins.alone.ids[1], &desc));
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  if (computes(info_of(gl).tier)) {
    // The same for the next instance, with the transform in a buffer. nook_gl_scene_set_poses ends the clip.
    const HostBuffer buffer(context.gl(), std::as_bytes(std::span(rows)));
    NOOK_OK_OR_FAIL(nook_scene_set_pose(twins.alone.scene, twins.alone.ids[2], &desc));
    nook_scene_instance_info info{};
    info.struct_size = sizeof info;
    NOOK_OK_OR_FAIL(nook_scene_describe_instance(twins.alone.scene, twins.alone.ids[2], &info));
    desc.transforms = nullptr;
    nook_gl_poses poses{};
    poses.struct_size = sizeof poses;
    poses.pose = &desc;
    poses.buffer = buffer.name();
    poses.size = sizeof rows;
    nook_gl_instance_pose one{};
    one.instance = twins.crowd.ids[2];
    std::copy_n(info.bound_centre_ws, 3, one.bound_centre_ws);
    one.bound_radius = info.bound_radius;
    // A bone of the sample has the scale of the place or less.
    one.scale = 1;
    one.place_3x4[0] = one.place_3x4[5] = one.place_3x4[10] = 1;
    NOOK_OK_OR_FAIL(nook_gl_scene_set_poses(gl, twins.crowd.scene, &poses, &one, 1));
    CHECK(twins.difference(gl).largest <= 1e-3f);  // of the ground, whose sphere follows the scale
    // A clip on the GPU again.
    CHECK(twins.difference(gl, all).largest <= bound_of_samples);
  }
  nook_gl_destroy(&gl);
}

TEST_CASE("clips of a crowd allocate nothing in a frame, wait for nothing and query only to preserve") {
  NOOK_NEED_CONTEXT(context);
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    Trace trace(context);
    SampleTwins twins;
    nook_gl gl = create_gl(twins.host.handle, Trace::loader, &trace, 0, mode);
    const auto frame = [&](double seconds) {
      NOOK_OK_OR_FAIL(twins.set_crowd(twins.playing(1, seconds, 0.13)));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
    };
    frame(0);
    trace.reset();
    const long allocations = twins.host.allocations;
    for (int i = 0; i < 3; ++i) frame(0.1 * i);
    CHECK(twins.host.allocations == allocations);
    CHECK(trace.forbidden_in_frame(mode == NOOK_GL_STATE_PRESERVE) == std::set<std::string>());
    nook_gl_destroy(&gl);
  }
}

TEST_CASE("clips of a crowd keep the state contract") {
  NOOK_NEED_CONTEXT(context);
  const unsigned users = users_of_tier(tiers_of(context).front());
  for (const nook_gl_state_mode mode : {NOOK_GL_STATE_PRESERVE, NOOK_GL_STATE_DEFAULTS, NOOK_GL_STATE_HOST}) {
    INFO("mode " << mode);
    SampleTwins twins;
    nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0, mode);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
    // The first update makes the program and the table.
    for (int step = 0; step < 2; ++step) {
      INFO("step " << step);
      Poison poison(context, users);
      if (mode == NOOK_GL_STATE_DEFAULTS) poison.reset_touched();
      const StateValues touched = poison.touched(), untouched = poison.untouched();
      NOOK_OK_OR_FAIL(twins.set_crowd(twins.playing(1, step, 0.5)));
      NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
      if (mode == NOOK_GL_STATE_PRESERVE) CHECK(poison.touched() == touched);
      if (mode == NOOK_GL_STATE_DEFAULTS) CHECK(poison.touched() == poison.defaults());
      CHECK(poison.untouched() == untouched);
    }
    CHECK(context.gl().GetError() == GL_NO_ERROR);
    CHECK(twins.difference(gl, twins.playing(1, 0, 0.5)).largest <= bound_of_samples);
    nook_gl_destroy(&gl);
  }
  for (const std::string& message : take_debug_messages()) FAIL_CHECK(message);
}

TEST_CASE("every refused allocation of a crowd's clips gives an error and leaves everything usable") {
  NOOK_NEED_CONTEXT(context);
  int refusals = 0;
  for (long n = 0;; ++n) {
    INFO("allocation " << n);
    SampleTwins twins;
    nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
    NOOK_OK_OR_FAIL(nook_gl_scene_update(gl, twins.crowd.scene));
    const auto all = twins.playing(1, 0, 0.5);
    NOOK_OK_OR_FAIL(twins.set_crowd(all));
    twins.host.refuse_after = n;
    const nook_result result = nook_gl_scene_update(gl, twins.crowd.scene);
    twins.host.refuse_after = -1;
    if (result != NOOK_OK) CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(twins.difference(gl, all).largest <= bound_of_samples);
    const bool needs_memory = computes(info_of(gl).tier);
    nook_gl_destroy(&gl);
    if (result == NOOK_OK) {
      CHECK(refusals >= (needs_memory ? 1 : 0));  // the list of tables; numbers are packed in pieces
      break;
    }
    ++refusals;
  }
}

TEST_CASE("a crowd's clips that cannot be played are refused, and nothing changes") {
  NOOK_NEED_CONTEXT(context);
  SampleTwins twins;
  nook_gl gl = create_gl(twins.host.handle, platform::Context::loader, &context, 0);
  const auto good = twins.playing(1, 0, 0.5);
  CHECK(twins.difference(gl, good).largest <= bound_of_samples);
  using Some = std::vector<nook_instance_clip>;
  const auto refused = [&](const char* text, nook_result code, const std::function<void(Some&)>& change) {
    INFO(text);
    Some some = twins.playing(1, 1, 0.5);
    change(some);
    CHECK(twins.set_crowd(some) == code);
    INFO(nook_last_message());
    CHECK(says(text));
  };
  constexpr nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;
  refused("instances[3].time.clip", invalid, [](Some& s) { s[3].time.clip = 2; });
  refused("instances[3].time.wrap", invalid, [](Some& s) { s[3].time.wrap = 2; });
  refused("instances[3].time.seconds", invalid, [](Some& s) { s[3].time.seconds = NAN; });
  refused("instances[3].time.seconds", invalid, [](Some& s) { s[3].time.seconds = -INFINITY; });
  refused("instances[8].place_3x4", invalid, [](Some& s) { s[8].place_3x4[3] = NAN; });
  refused("is not a rotation", invalid, [](Some& s) { s[8].place_3x4[5] *= 1.1f; });
  refused("is not a rotation", invalid, [](Some& s) { std::fill_n(s[8].place_3x4, 12, 0.0f); });
  refused("far too large", invalid, [](Some& s) {
    for (const int k : {2, 5, 8}) s[8].place_3x4[k] *= 9.99e5f;
  });
  refused("instance 12345", NOOK_ERROR_INVALID_HANDLE, [](Some& s) { s[3].instance = 12345; });
  refused("occurs twice", invalid, [](Some& s) { s[3].instance = s[7].instance; });
  refused("instances[2].reserved", invalid, [](Some& s) { s[2].reserved = 1; });
  CHECK(nook_scene_set_clips(twins.crowd.scene, twins.clips, nullptr, 1) == invalid);
  CHECK(nook_scene_set_clips(twins.crowd.scene, nullptr, good.data(), 1) == invalid);
  CHECK(nook_scene_set_clips(nullptr, twins.clips, good.data(), 1) == invalid);
  NOOK_OK_OR_FAIL(nook_scene_set_clips(twins.crowd.scene, twins.clips, nullptr, 0));
  // A second model.
  nook_model other = load_model(twins.host.handle, sample_model(32));
  nook_instance_id stranger = 0;
  NOOK_OK_OR_FAIL(nook_scene_add_instance(twins.crowd.scene, other, &stranger));
  refused("does not have the model", invalid, [&](Some& s) { s[3].instance = stranger; });
  NOOK_OK_OR_FAIL(nook_scene_remove_instance(twins.crowd.scene, stranger));
  nook_model_destroy(&other);
  CHECK(twins.difference(gl).largest <= bound_of_samples);
  nook_gl_destroy(&gl);
}
