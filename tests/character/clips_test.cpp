// Baked clips: their file, their times, and scenes that take AO and poses from them.
#include <algorithm>
#include <cmath>
#include <string>

#include "sdk/src/character/bone_axes.h"
#include "sdk/src/character/clip_set.h"
#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/loaded_clips.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// Sums of eight products in floats.
constexpr float rounding = 2e-6f;

std::string failure_of(nook_result code, std::span<const std::byte> bytes) {
  try {
    (void)read_clip_set(bytes);
  } catch (const Failure& failure) {
    CHECK(failure.code() == code);
    return failure.what();
  }
  return "no failure";
}

bool mentions(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

Ref<const LoadedClips> load_clips(const ClipSet& set, const Ref<const LoadedModel>& model) {
  return Owned<LoadedClips>::make(default_memory(), Ref<const RefCounted>(), ClipSet(set), model,
                                  default_memory());
}

Mat3x4 moved(float x, float y, float z) {
  return {{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z}};
}

}  // namespace

TEST_CASE("a file of clips holds what was written") {
  const ClipSet set = sample_clips(sample_model()).set;
  const std::vector<std::byte> bytes = write_clip_set(set);
  const ClipSet read = read_clip_set(bytes);
  REQUIRE(read.clips.size() == 2);
  CHECK(read.clips[1].name == "walk");
  CHECK(read.clips[1].duration_s == 2);
  CHECK(read.clips[1].first_frame == 1);
  CHECK(read.ao.mode == set.ao.mode);
  CHECK(read.ao.weight == set.ao.weight);
  CHECK(read.pose.mode == set.pose.mode);
  CHECK(read.pose.scale == set.pose.scale);
  CHECK(read.bones[3].centre == set.bones[3].centre);
  CHECK(read.recipe == set.recipe);
  CHECK(write_clip_set(read) == bytes);
}

TEST_CASE("a file of clips that is cut or changed is refused") {
  const std::vector<std::byte> bytes = write_clip_set(sample_clips(sample_model()).set);
  for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 37)
    CHECK(failure_of(NOOK_ERROR_BAD_FILE, std::span(bytes).first(size)) != "no failure");
  for (std::size_t i = 12; i < bytes.size(); i += i < 200 ? 1 : 41) {
    std::vector<std::byte> changed = bytes;
    changed[i] ^= std::byte{0x10};
    CHECK(failure_of(NOOK_ERROR_BAD_FILE, changed) != "no failure");
  }
}

TEST_CASE("numbers behind a correct checksum are checked") {
  const auto refused = [](auto&& change) {
    ClipSet set = sample_clips(sample_model()).set;
    change(set);
    try {
      check_clip_set(set, NOOK_ERROR_BAD_FILE);
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
      return std::string(failure.what());
    }
    return std::string("no failure");
  };
  CHECK(mentions(refused([](ClipSet& s) { s.frame_count = 7; }), "frames"));
  CHECK(mentions(refused([](ClipSet& s) { s.clips[1].first_frame = 2; }), "clip 1"));
  CHECK(mentions(refused([](ClipSet& s) { s.clips[0].duration_s = NAN; }), "duration of clip 0"));
  CHECK(mentions(refused([](ClipSet& s) { s.ao.scale[3] = INFINITY; }), "mode 3 of the AO"));
  CHECK(mentions(refused([](ClipSet& s) { s.pose.scale[0] = -1; }), "mode 0 of the pose"));
  CHECK(mentions(refused([](ClipSet& s) { s.ao.modes = 6; }), "multiple of 4"));
  CHECK(mentions(refused([](ClipSet& s) { s.bones[2].radius = 0; }), "bone 2"));
  CHECK(mentions(refused([](ClipSet& s) { s.bones.clear(); }), "bones"));
  CHECK(mentions(refused([](ClipSet& s) { s.ao.mode.pop_back(); }), "wrong length"));
}

TEST_CASE("a time of a clip is clamped or repeated, and lies between two frames") {
  const ClipSet set = sample_clips(sample_model()).set;
  const ClipRange& walk = set.clips[1];
  const auto is = [&](double time_s, bool loop, std::uint32_t first, float share) {
    const FrameMix mix = frame_mix(walk, time_s, loop);
    CHECK(mix.first == 1 + first);
    CHECK(mix.second <= 5);
    CHECK(std::abs(mix.share - share) < 1e-5f);
  };
  // Five frames in two seconds: one every half second.
  is(0, false, 0, 0);
  is(0.75, false, 1, 0.5f);
  is(-3, false, 0, 0);
  is(2, false, 4, 0);
  is(1e300, false, 4, 0);
  is(0.5, false, 1, 0);
  is(2.25, true, 0, 0.5f);
  is(-0.25, true, 3, 0.5f);
  is(20.25, true, 0, 0.5f);
  // The last frame is at the duration, which a loop takes as its start.
  is(2, true, 0, 0);
  const FrameMix still = frame_mix(set.clips[0], 7.5, true);
  CHECK(still.first == 0);
  CHECK(still.second == 0);
  CHECK(still.share == 0);
}

TEST_CASE("an instance with a clip has the AO of its formula, and links multiply it") {
  // More vertices than a block of slots, so that blocks meet.
  const CharacterModel plain = sample_model(3, {5, 7, 12, 700, 30, 4});
  const auto model = load(plain);
  const ClipSample sample = sample_clips(plain);
  const auto clips = load_clips(sample.set, model);
  Scene scene = make_scene({});
  const nook_instance_id id = add_instance(scene, model), caster = add_instance(scene, model);
  const FrameMix mix = frame_mix(sample.set.clips[1], 0.6, false);
  set_clip(scene, id, clips, mix, Mat3x4{});
  set_clip(scene, caster, clips, frame_mix(sample.set.clips[0], 0, false), moved(0.3f, 0.2f, 0));
  update(scene);
  const std::vector<float> alone = ao_of(scene, id);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    const double truth =
        sample_ao(sample.set, mix.first, mix.second, double(mix.share), plain.file_to_welded[i]);
    REQUIRE(std::abs(double(alone[i]) - truth) < double(rounding));
  }

  link(scene, id, caster);
  const Plane ground{{0, 1, 0}, -0.5f};
  set_ground(scene, id, &ground);
  update(scene);
  const std::vector<float> all = ao_of(scene, id);
  scene.terms = NOOK_TERM_LINKS | NOOK_TERM_GROUND;
  update(scene);
  const std::vector<float> added = ao_of(scene, id);
  float darkest = 1;
  for (std::size_t i = 0; i < all.size(); ++i) {
    REQUIRE(std::abs(all[i] - alone[i] * added[i]) < rounding);
    darkest = std::min(darkest, added[i]);
  }
  CHECK(darkest < 0.9f);

  // Under constant light the channels are AO; two estimates of roots in each term, as in
  // scene_light_test.cpp.
  scene.terms = NOOK_TERM_ALL;
  set_light(scene, id, std::vector<SphericalGaussian>{{{0, 1, 0}, 0, {0.5f, 1, 2}}});
  update(scene);
  std::vector<float> lit(3 * all.size());
  read_directional_ao(scene, instance_of(scene, id), lit.data(), 12);
  for (std::size_t i = 0; i < lit.size(); ++i) REQUIRE(std::abs(lit[i] - all[i / 3]) < 2e-3f);
}

TEST_CASE("the poses of a set are those that were planted, at a place, and mixed between frames") {
  const CharacterModel plain = sample_model();
  const ClipSample sample = sample_clips(plain);
  // Sixteen bits over some 0.8 m, and a rotation whose rows are as small as the radius of its bone.
  constexpr float tolerance = 1e-3f;
  const Mat3x4 place{{0, 0, 2, 5, 0, 2, 0, -1, -2, 0, 0, 3}};
  for (std::uint32_t f = 0; f < 6; ++f)
    for (std::size_t b = 0; b < plain.bone_count(); ++b) {
      const Mat3x4 got = decode_bone(sample.set, {f, f, 0}, place, b), want = place * sample.poses[f][b];
      for (int i = 0; i < 12; ++i) REQUIRE(std::abs(got.m[i] - want.m[i]) < tolerance);
    }
  // Between two poses the matrix of a bone stays a rotation, and its centre lies on the line.
  const Mat3x4 between = decode_bone(sample.set, {2, 3, 0.5f}, Mat3x4{}, 1);
  const Vec3 x{between.m[0], between.m[4], between.m[8]}, y{between.m[1], between.m[5], between.m[9]};
  CHECK(std::abs(dot(x, y)) < 1e-4f * dot(x, x));
  CHECK(std::abs(dot(x, x) - dot(y, y)) < 1e-4f * dot(x, x));
  const Vec3 centre = sample.set.bones[1].centre;
  const Vec3 middle =
      (transform_point(sample.poses[2][1], centre) + transform_point(sample.poses[3][1], centre)) * 0.5f;
  CHECK(length(transform_point(between, centre) - middle) < tolerance);
}

TEST_CASE("a pose of the host ends the clip of an instance, and so does another model") {
  const CharacterModel plain = sample_model();
  const auto model = load(plain), other = load(plain);
  const ClipSample sample = sample_clips(plain);
  const auto clips = load_clips(sample.set, model);
  Scene scene = make_scene({});
  const nook_instance_id id = add_instance(scene, model), live = add_instance(scene, model);
  set_clip(scene, id, clips, {1, 2, 0.25f}, Mat3x4{});
  const std::vector<Mat3x4> pose = stiff_pose(plain, {0, 0, 0});
  set_pose(scene, id, pose);
  set_pose(scene, live, pose);
  update(scene);
  CHECK(ao_of(scene, id) == ao_of(scene, live));
  CHECK_THROWS_AS(set_clip(scene, live, load_clips(sample.set, other), {1, 2, 0}, Mat3x4{}), Failure);
  set_clip(scene, id, clips, {1, 2, 0.25f}, Mat3x4{});
  set_model(scene, id, other);
  set_pose(scene, id, pose);
  update(scene);
  CHECK(ao_of(scene, id) == ao_of(scene, live));
}

TEST_CASE("clips of another character are refused") {
  const CharacterModel plain = sample_model();
  const ClipSet set = sample_clips(plain).set;
  CharacterModel renamed = plain;
  renamed.bone_names[0] = "another";
  for (const CharacterModel& other : {renamed, sample_model(2)}) {
    try {
      (void)load_clips(set, load(other));
      FAIL("the clips were accepted");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      CHECK(mentions(failure.what(), "another character"));
    }
  }
  // A new bake of the character keeps its orders.
  CharacterModel again = plain;
  again.alpha[0] += 0.1f;
  again.spheres.pop_back();
  CHECK_NOTHROW(load_clips(set, load(again)));
}

TEST_CASE(
    "clips follow a model into the order of a host's mesh, and not into another order of its vertices") {
  const CharacterModel plain = sample_model(5, {5, 7, 12, 300, 20, 4});
  const ClipSet set = sample_clips(plain).set;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < plain.file_to_welded.size(); i += 2) order.push_back(i);
  for (std::uint32_t i = 1; i < plain.file_to_welded.size(); i += 2) order.push_back(i);
  const auto model = load(remapped(plain, order, default_memory()));
  const auto clips = load_clips(set, model);
  Scene scene = make_scene({});
  const nook_instance_id id = add_instance(scene, model);
  set_clip(scene, id, clips, {1, 2, 0.5f}, Mat3x4{});
  update(scene);
  const std::vector<float> ao = ao_of(scene, id);
  REQUIRE(ao.size() == order.size());
  for (std::size_t i = 0; i < ao.size(); ++i)
    REQUIRE(std::abs(double(ao[i]) - sample_ao(set, 1, 2, 0.5, plain.file_to_welded[order[i]])) <
            double(rounding));
  CharacterModel reversed = plain;
  std::reverse(reversed.rest.position.begin(), reversed.rest.position.end());
  CHECK_THROWS_AS(load_clips(set, load(reversed)), Failure);
}

TEST_CASE("the bound of a mix of frames holds the body, and in a frame it is the bound of its bones") {
  const CharacterModel plain = sample_model();
  const auto model = load(plain);
  // Random frames turn bones by up to half a turn between two, which is more than any clip does.
  for (const std::uint32_t seed : {1u, 2u, 3u, 4u}) {
    const ClipSample sample = sample_clips(plain, seed);
    const auto clips = load_clips(sample.set, model);
    for (int step = 0; step <= 80; ++step) {
      const FrameMix mix = frame_mix(sample.set.clips[1], 2.0 * step / 80, false);
      const PoseBound bound = bound_of_mix(*clips, mix);
      std::vector<Mat3x4> bones(plain.bone_count());
      float longest_squared = 0;
      for (std::size_t b = 0; b < bones.size(); ++b) {
        bones[b] = decode_bone(sample.set, mix, Mat3x4{}, b);
        longest_squared = std::max(longest_squared, axes_of(bones[b]).longest_squared);
      }
      const PoseBound of_bones = bound_of_bones(*model, bones, longest_squared);
      INFO("seed " << seed << ", step " << step << ", share " << mix.share);
      CHECK(bound.scale >= of_bones.scale - rounding);
      float farthest = 0;
      for (std::size_t b = 0; b < bones.size(); ++b) {
        const LoadedModel::BoneBound& part = model->bone_bounds[b];
        if (part.radius < 0) continue;
        const float scale = std::sqrt(axes_of(bones[b]).longest_squared);
        farthest = std::max(
            farthest, length(transform_point(bones[b], part.centre) - bound.centre) + scale * part.radius);
      }
      CHECK(bound.radius >= farthest - rounding);
      if (mix.share > 0) continue;
      CHECK(bound.centre == of_bones.centre);
      CHECK(bound.radius == of_bones.radius);
      CHECK(bound.scale == of_bones.scale);
    }
  }
}
