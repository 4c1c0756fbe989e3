// Levels of detail: what they cost in AO, what they save, and that the stated error is the one that is met.
#include <algorithm>
#include <cmath>

#include "bakers/character/levels.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// Bones turned a little about points of their own, as joints are.
std::vector<Mat3x4> random_pose(Numbers& numbers, std::size_t bones) {
  std::vector<Mat3x4> pose;
  for (std::size_t b = 0; b < bones; ++b) {
    const float turn = numbers.between(-0.6f, 0.6f), c = std::cos(turn), s = std::sin(turn);
    const Vec3 move = numbers.place(0.05f);
    pose.push_back({{c, -s, 0, move.x, s, c, 0, move.y, 0, 0, 1, move.z}});
  }
  return pose;
}

std::vector<std::vector<Mat3x4>> random_poses(std::uint32_t seed, std::size_t count, std::size_t bones) {
  Numbers numbers(seed);
  std::vector<std::vector<Mat3x4>> poses;
  for (std::size_t i = 0; i < count; ++i) poses.push_back(random_pose(numbers, bones));
  return poses;
}

CharacterModel model_with_levels() {
  CharacterModel model = sample_model(41, {6, 60, 120, 400, 40, 4});
  for (float& alpha : model.alpha) alpha *= 0.3f;
  for (const CharacterLevel& level : bake::make_levels(model, random_poses(1, 80, model.bone_count())))
    model.levels.push_back(level);
  return model;
}

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += double(a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE("coarser levels evaluate less, and their stated error holds on poses they never saw") {
  const CharacterModel data = quantise(model_with_levels());
  REQUIRE(data.levels.size() == 2);
  CHECK(data.levels[0].error_rms < data.levels[1].error_rms);
  const auto model = load(data);
  const auto poses = random_poses(99, 30, data.bone_count());
  for (std::size_t l = 0; l < data.levels.size(); ++l) {
    SceneSettings settings;
    settings.lod_distance = 1;
    // Just above the level's error at one lod_distance.
    settings.lod_error = data.levels[l].error_rms * 1.001f;
    Scene coarse = make_scene(settings), fine = make_scene();
    coarse.has_camera = true;
    const nook_instance_id a = add_instance(coarse, model), b = add_instance(fine, model);
    double sum = 0;
    for (const auto& pose : poses) {
      set_pose(coarse, a, pose);
      set_pose(fine, b, pose);
      coarse.camera = instance_of(coarse, a).input.bound.centre + Vec3{0, 0, 1};
      update(coarse);
      update(fine);
      REQUIRE(instance_of(coarse, a).plan.level == l + 1);
      const double error = rms(ao_of(coarse, a), ao_of(fine, b));
      sum += error * error;
    }
    const double measured = std::sqrt(sum / static_cast<double>(poses.size()));
    // 30 poses estimate an rms to some 10 %; file vertices weight welded ones a little differently; codes of
    // 8 bits add theirs.
    CHECK(measured < 1.25 * data.levels[l].error_rms);
    CHECK(measured > 0.5 * data.levels[l].error_rms);
    CHECK(coarse.stats.evaluations * 4 < fine.stats.evaluations);
  }
}

TEST_CASE("without a camera or with lod_error 0 every instance keeps full detail") {
  const auto model = load(model_with_levels());
  for (const bool camera : {false, true}) {
    SceneSettings settings;
    settings.lod_error = camera ? 0.0f : 1.0f;
    Scene scene = make_scene(settings);
    scene.has_camera = camera;
    const nook_instance_id id = place(scene, model, {1000, 0, 0});
    update(scene);
    CHECK(instance_of(scene, id).plan.level == 0);
  }
}

TEST_CASE("a level darkens by linked casters about as full detail does") {
  const auto model = load(model_with_levels());
  const auto run = [&](float lod_error) {
    SceneSettings settings;
    settings.lod_error = lod_error;
    settings.cutoff_error = 0;
    Scene scene = make_scene(settings);
    scene.has_camera = true;
    scene.camera = {0, 0, 50};
    scene.terms = NOOK_TERM_LINKS;
    const nook_instance_id id = add_instance(scene, model);
    link(scene, id, place(scene, model, {1.5f, 0, 0}));
    update(scene);
    double sum = 0;
    const std::vector<float> ao = ao_of(scene, id);
    for (const float value : ao) sum += 1 - value;
    return sum / static_cast<double>(ao.size());
  };
  const double full = run(0), coarse = run(1);
  CHECK(full > 0.01);
  // Merged spheres keep the sum of weight * radius^2. Key points take over from others that are alike, which
  // random ones are not quite, and random blend weights of either sign amplify the difference.
  CHECK(std::abs(coarse / full - 1) < 0.35);
}

TEST_CASE("a level may follow the paper's form and survives being flipped at every byte of its section") {
  const std::vector<std::byte> good = write_character_model(model_with_levels());
  const auto name = std::vector<std::byte>{std::byte{'L'}, std::byte{'O'}, std::byte{'D'}, std::byte{'S'}};
  const auto entry = std::search(good.begin(), good.end(), name.begin(), name.end()) - good.begin();
  REQUIRE(static_cast<std::size_t>(entry) + 24 < good.size());
  const std::span<const std::byte> file_bytes = good;
  ByteReader reader(file_bytes.subspan(static_cast<std::size_t>(entry) + 8, 16), "table");
  const std::size_t offset = reader.u64(), size = reader.u64();
  for (std::size_t i = offset; i < offset + size; ++i) {
    auto file = good;
    file[i] ^= std::byte{0xff};
    repair_checksum(file);
    try {
      SceneSettings settings;
      settings.lod_error = 1e6f;
      settings.form = i % 2 ? NOOK_FORM_PAPER : NOOK_FORM_DEFAULT;
      Scene scene = make_scene(settings);
      scene.has_camera = true;
      const nook_instance_id id = place(scene, load(read_character_model(file)), {10, 0, 0});
      update(scene);
      for (const float ao : ao_of(scene, id)) REQUIRE((ao >= 0 && ao <= 1));
    } catch (const Failure& failure) {
      REQUIRE(failure.code() == NOOK_ERROR_BAD_FILE);
    }
  }
}

TEST_CASE("levels need poses") {
  const CharacterModel model = sample_model();
  CHECK_THROWS_AS(bake::make_levels(model, random_poses(1, 3, model.bone_count())), Failure);
  CHECK_THROWS_AS(bake::make_levels(model, random_poses(1, 8, model.bone_count() - 1)), Failure);
}
