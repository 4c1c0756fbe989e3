// Bent normals as hosts read them.
#include <cmath>
#include <vector>

#include "sdk/src/character/bent_normal.h"
#include "sdk/src/character/model_file.h"
#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::test;

namespace {

// Half a step of a byte on each of three axes.
constexpr float byte_error = 0.5f / 127 * 1.7320508f + 1e-6f;

CharacterModel bent_model() {
  CharacterModel model = sample_model(3);
  Numbers numbers(23);
  add_occluded(model, numbers);
  return quantise(model);
}

struct BentStage {
  explicit BentStage(const CharacterModel& of) : count(std::uint32_t(of.file_to_welded.size())) {
    const std::vector<std::byte> bytes = write_character_model(of);
    const nook_scene_desc desc = Host::scene_desc();
    nook_context_desc context_desc;
    REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
    REQUIRE(nook_context_create(&context_desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, bytes.data(), bytes.size(), &model) == NOOK_OK);
    REQUIRE(nook_scene_create(context, &desc, &scene) == NOOK_OK);
    REQUIRE(nook_scene_add_instance(scene, model, &id) == NOOK_OK);
  }
  ~BentStage() {
    nook_scene_destroy(&scene);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }

  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id id = 0;
  std::uint32_t count;  // file vertices
};

Vec3 decoded(const std::int8_t* bytes) {
  return {decode_coordinate(bytes[0]), decode_coordinate(bytes[1]), decode_coordinate(bytes[2])};
}

constexpr Mat3x4 turn_90{{0, 0, 1, 5, 0, 1, 0, 0, -1, 0, 0, 2}};  // about y, and a move

}  // namespace

std::vector<std::byte> nook_test_bent_model_bytes() {
  return write_character_model(bent_model());
}

TEST_CASE("bent normals turn with the pose and hold the AO of the update") {
  const CharacterModel model = bent_model();
  const BentStage stage(model);
  std::vector<float> ao(stage.count);
  const auto read = [&](const Mat3x4& bone) {
    const std::vector<Mat3x4> pose(model.bone_count(), bone);
    REQUIRE(nook::test::set_rows(stage.scene, stage.id, pose[0].m, pose.size()) == NOOK_OK);
    REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
    REQUIRE(nook_scene_read(stage.scene, stage.id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(), stage.count,
                            0) == NOOK_OK);
    std::vector<std::int8_t> bytes(4 * stage.count);
    REQUIRE(nook_scene_read(stage.scene, stage.id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, bytes.data(),
                            stage.count, 0) == NOOK_OK);
    return bytes;
  };
  const std::vector<std::int8_t> rest = read({}), turned = read(turn_90);
  for (std::uint32_t i = 0; i < stage.count; ++i) {
    const std::size_t v = model.file_to_welded[i];
    const Vec3 left = open_hemisphere * model.rest.normal[v] - model.occluded[v].at(ao[i]);
    // AO goes through a byte of 255 steps, which moves the occluded direction by at most 1 / 510 of its
    // change.
    const float change = length(model.occluded[v].dark - model.occluded[v].open) / 510 / length(left);
    const Vec3 bent = decoded(&rest[4 * i]);
    CHECK(length(bent - normalised(left)) < byte_error + change);
    CHECK(std::abs(decode_coordinate(rest[4 * i + 3]) - ao[i]) < 0.5f / 127 + 0.5f / 255 + 1e-6f);
    CHECK(length(decoded(&turned[4 * i]) - transform_vector(turn_90, bent)) < 2 * (byte_error + change));
  }
}

TEST_CASE("models without bent normals are refused, and so are wrong arguments") {
  const BentStage with(bent_model()), without(sample_model(3));
  std::vector<std::int8_t> out(8 * with.count);
  const auto occluded = [](nook_model model, std::int8_t* to, std::uint32_t count, std::size_t stride) {
    return nook_model_read(model, NOOK_MODEL_OCCLUDED_DIRECTIONS, to, count, stride);
  };
  const auto bent = [](nook_scene scene, nook_instance_id id, std::int8_t* to, std::uint32_t count,
                       std::size_t stride) {
    return nook_scene_read(scene, id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, to, count, stride);
  };
  CHECK(occluded(without.model, out.data(), without.count, 0) == NOOK_ERROR_UNSUPPORTED);
  CHECK(bent(without.scene, without.id, out.data(), without.count, 0) == NOOK_ERROR_UNSUPPORTED);
  CHECK(occluded(nullptr, out.data(), with.count, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(occluded(with.model, nullptr, with.count, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(occluded(with.model, out.data(), with.count - 1, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(occluded(with.model, out.data(), with.count, 7) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(bent(nullptr, with.id, out.data(), with.count, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(bent(with.scene, with.id, nullptr, with.count, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(bent(with.scene, with.id, out.data(), with.count + 1, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(bent(with.scene, with.id, out.data(), with.count, 3) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(bent(with.scene, 99, out.data(), with.count, 0) == NOOK_ERROR_INVALID_HANDLE);
}

TEST_CASE(
    "occluded directions are two vectors of bytes, each with a 0 behind it, and bent normals take a stride") {
  const BentStage stage(bent_model());
  std::vector<std::int8_t> occluded(8 * stage.count, 7), bent(4 * stage.count), wide(8 * stage.count, 7);
  REQUIRE(nook_model_read(stage.model, NOOK_MODEL_OCCLUDED_DIRECTIONS, occluded.data(), stage.count, 0) ==
          NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, bent.data(),
                          stage.count, 0) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.id, NOOK_CHANNEL_BENT_NORMAL, NOOK_FORMAT_SNORM8, wide.data(),
                          stage.count, 8) == NOOK_OK);
  for (std::size_t i = 0; i < occluded.size(); ++i) {
    if (i % 4 == 3) CHECK(occluded[i] == 0);
    CHECK(wide[i] == (i % 8 < 4 ? bent[i / 8 * 4 + i % 8] : 7));
  }
}
