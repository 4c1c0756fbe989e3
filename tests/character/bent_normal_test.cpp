// Bent normals and occluded directions without ray tracing: closed forms, the file, and what hosts read.
#include "sdk/src/character/bent_normal.h"

#include <numbers>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "sdk/src/character/occluded_directions.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;

namespace {

// Half a step of a byte on each of three axes.
constexpr float byte_error = 0.5f / 127 * 1.7320508f + 1e-6f;

Vec3 decoded(const std::int8_t* bytes) {
  return {decode_coordinate(bytes[0]), decode_coordinate(bytes[1]), decode_coordinate(bytes[2])};
}

CharacterModel bent_model(std::uint32_t seed = 3) {
  CharacterModel model = test::sample_model(seed);
  test::Numbers numbers(seed + 20);
  test::add_occluded(model, numbers);
  return model;
}

}  // namespace

TEST_CASE("a bent normal is the normal where nothing or everything is occluded") {
  const Vec3 normal = normalised({1, 2, 3});
  CHECK(length(bent_normal(normal, {}) - normal) < 1e-6f);
  CHECK(bent_normal(normal, open_hemisphere * normal) == normal);
}

TEST_CASE("a wall that rises from a point on a floor bends the normal by atan(2 / pi)") {
  // The mean over the quarter sphere z > 0, x > 0 under cos / pi has x = 2 / (3 pi) and z = 1 / 3.
  const float pi = std::numbers::pi_v<float>;
  const Vec3 bent = bent_normal({0, 0, 1}, {2 / (3 * pi), 0, 1.0f / 3});
  CHECK(std::abs(std::atan2(-bent.x, bent.z) - std::atan(2 / pi)) < 1e-5f);
  CHECK(std::abs(bent.y) < 1e-6f);
}

TEST_CASE("occluded directions come back from a file within half a step, in six bytes for each vertex") {
  const CharacterModel model = bent_model();
  CharacterModel without = model;
  without.occluded.clear();
  CHECK(quantise(without).occluded.empty());
  // A name, an offset and a size in the list of sections.
  CHECK(write_character_model(model).size() <=
        write_character_model(without).size() + 6 * model.vertex_count() + 32);
  const CharacterModel read = quantise(model);
  REQUIRE(read.occluded.size() == model.occluded.size());
  for (std::size_t i = 0; i < read.occluded.size(); ++i) {
    CHECK(length(read.occluded[i].dark - model.occluded[i].dark) < byte_error);
    CHECK(length(read.occluded[i].open - model.occluded[i].open) < byte_error);
  }
  CHECK(write_character_model(read) == write_character_model(quantise(read)));

  CharacterModel bad = model;
  bad.occluded.pop_back();
  CHECK_THROWS_AS(write_character_model(bad), Failure);
  bad = model;
  bad.occluded[2].open.y = std::nanf("");
  CHECK_THROWS_AS(write_character_model(bad), Failure);
  bad.occluded[2].open.y = 1.5f;
  CHECK_THROWS_AS(write_character_model(bad), Failure);
}

TEST_CASE("a host reads occluded directions in the space of its normals") {
  const CharacterModel model = quantise(bent_model());
  std::vector<std::int8_t> bytes(occluded_bytes * model.file_to_welded.size());
  copy_occluded_directions(model, bytes.data(), occluded_bytes);
  for (std::size_t p = 0; p < model.primitives.size(); ++p) {
    const Mat3x4& rest_from_mesh = model.bind.rest_from_mesh[model.bind.primitive_space[p]];
    const float scale = length(transform_vector(rest_from_mesh, {1, 0, 0}));
    for (std::uint32_t i = 0; i < model.primitives[p].vertex_count; ++i) {
      const std::size_t file_vertex = model.primitives[p].first_vertex + i;
      const OccludedEnds& want = model.occluded[model.file_to_welded[file_vertex]];
      const auto in_rest = [&](std::size_t byte) {
        return transform_vector(rest_from_mesh, decoded(&bytes[file_vertex * occluded_bytes + byte])) *
               (1 / scale);
      };
      // A vector with a coordinate near 1 may turn out of the box of the bytes, and is cut there.
      if (length(want.dark) < 1) CHECK(length(in_rest(0) - want.dark) < byte_error);
      if (length(want.open) < 1) CHECK(length(in_rest(4) - want.open) < byte_error);
      CHECK(bytes[file_vertex * occluded_bytes + 3] == 0);
    }
  }
}
