// Clips against closed forms.
#include "bakers/import/clip.h"

#include "sdk/src/core/failure.h"
#include "tests/bakers/import/tube_file.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::bake;
using namespace nook::test;

namespace {

Channel channel(ChannelPath path, Interpolation interpolation, std::vector<float> time_s,
                std::vector<float> value) {
  return {0, path, interpolation, std::move(time_s), std::move(value)};
}

Trs sample(const Channel& of, float time_s) {
  Clip clip;
  clip.duration_s = of.time_s.back();
  clip.channels = {of};
  std::vector<Trs> locals(1);
  apply_clip(clip, time_s, locals);
  return locals[0];
}

}  // namespace

TEST_CASE("linear translation, held beyond both ends") {
  const Channel c =
      channel(ChannelPath::translation, Interpolation::linear, {0, 1, 3}, {0, 0, 0, 2, 4, 6, 0, 0, 0});
  CHECK(std::abs(sample(c, 0.25f).translation[1] - 1) < 1e-6);
  CHECK(std::abs(sample(c, 2).translation[2] - 3) < 1e-6);
  CHECK(sample(c, -5).translation[0] == 0);
  CHECK(sample(c, 99).translation[0] == 0);
  CHECK(sample(c, 1).translation[0] == 2);
}

TEST_CASE("linear rotation is constant in angular speed and takes the shorter arc") {
  // A third of the way to 120 degrees about y is 40 degrees: w = cos 20, y = sin 20. The end quaternion is
  // negated, which is the same rotation.
  const float c60 = 0.5f;
  const float s60 = std::sqrt(3.0f) / 2;
  const Channel c =
      channel(ChannelPath::rotation, Interpolation::linear, {0, 3}, {0, 0, 0, 1, 0, -s60, 0, -c60});
  const Trs at = sample(c, 1);
  const double sign = at.rotation[3] < 0 ? -1 : 1;
  CHECK(std::abs(sign * at.rotation[3] - std::cos(M_PI / 9)) < 1e-7);  // float keys
  CHECK(std::abs(sign * at.rotation[1] - std::sin(M_PI / 9)) < 1e-7);
}

TEST_CASE("steps hold until the next key") {
  const Channel c = channel(ChannelPath::scale, Interpolation::step, {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3});
  CHECK(sample(c, 0.999f).scale[0] == 1);
  CHECK(sample(c, 1).scale[0] == 2);
  CHECK(sample(c, 2).scale[0] == 3);
}

TEST_CASE("a cubic spline reproduces the cubic it was made from") {
  // f(t) = t^3 - 2 t^2 + 3 t - 4 and its derivative at uneven keys; the Hermite form is exact for cubics.
  const auto f = [](double t) { return t * t * t - 2 * t * t + 3 * t - 4; };
  const auto df = [](double t) { return 3 * t * t - 4 * t + 3; };
  std::vector<float> times = {0, 0.5f, 2};
  std::vector<float> values;
  for (const float t : times)
    for (const double v : {df(t), f(t), df(t)}) values.insert(values.end(), 3, static_cast<float>(v));
  const Channel c = channel(ChannelPath::translation, Interpolation::cubic_spline, times, values);
  for (float t = 0; t <= 2; t += 0.0625f) CHECK(std::abs(sample(c, t).translation[0] - f(t)) < 1e-6);
}

TEST_CASE("a cubic rotation is normalised") {
  // Two keys of in-tangent, value, out-tangent: identity, then half a turn about y; no tangents.
  const Channel c = channel(ChannelPath::rotation, Interpolation::cubic_spline, {0, 1},
                            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  // Half way both weigh 1/2: (0, 1/2, 0, 1/2) normalised is a quarter turn.
  const Trs at = sample(c, 0.5f);
  CHECK(std::abs(at.rotation[1] - std::sqrt(0.5)) < 1e-12);
  CHECK(std::abs(at.rotation[3] - std::sqrt(0.5)) < 1e-12);
}

TEST_CASE("a clip starts at its first key, wherever the file has it") {
  GltfBuilder file = tube_file();
  file.add_animation("late");
  file.add_channel(2, "translation", {10, 12}, {0, 1, 0, 0, 3, 0});
  file.add_channel(1, "translation", {9, 10}, {0, 0, 0, 0, 0, 0});
  const ImportedCharacter character = load(file);
  REQUIRE(character.clips.size() == 2);
  CHECK(character.clips[1].start_s == 9);
  CHECK(character.clips[1].duration_s == 3);
  const Pose pose = sample_clip(character, 1, 2);
  CHECK(distance(transform_point(pose[1], {0, 1, 0}), {0, 2, 0}) < 1e-6f);
}

TEST_CASE("clip names are unique and never empty") {
  GltfBuilder file = tube_file();
  for (const char* name : {"", "bend", "bend_2", "bend"}) {
    file.add_animation(name);
    file.add_channel(2, "translation", {0}, {0, 1, 0});
  }
  const ImportedCharacter character = load(file);
  REQUIRE(character.clips.size() == 5);
  CHECK(character.clips[0].name == "bend");
  CHECK(character.clips[1].name == "clip_1");
  CHECK(character.clips[2].name == "bend_3");
  CHECK(character.clips[3].name == "bend_2");
  CHECK(character.clips[4].name == "bend_4");
  for (std::size_t i = 0; i < character.clips.size(); ++i)
    CHECK(find_clip(character, character.clips[i].name) == i);
}

TEST_CASE("an unknown clip is refused, and the message lists the existing clips") {
  GltfBuilder file = tube_file();
  file.add_animation("walk");
  file.add_channel(2, "translation", {0}, {0, 1, 0});
  const ImportedCharacter character = load(file);
  try {
    find_clip(character, "run");
    FAIL("found a clip that is not there");
  } catch (const Failure& failure) {
    CHECK(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
    CHECK(std::string(failure.what()) == "no clip is called \"run\"; this file has bend, walk");
  }
  CHECK_THROWS_AS(sample_clip(character, 2, 0), Failure);
}

TEST_CASE("clips of morph targets only are left out") {
  GltfBuilder file = tube_file();
  file.add_animation("smile");
  file.add_channel(3, "weights", {0, 1}, {0, 0, 0, 1, 1, 1});
  const ImportedCharacter character = load(file);
  CHECK(character.clips.size() == 1);
  CHECK(has_warning(character.warnings, "\"smile\" moves no node"));
}

TEST_CASE("a time that is not a number gives a finite pose") {
  const ImportedCharacter character = load(tube_file());
  const Pose pose = sample_clip(character, 0, NAN);
  for (const float v : pose[1].m) CHECK(std::isfinite(v));
}
