#include "sdk/src/character/model_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <string>

#include "sdk/src/character/model.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;

namespace {

// The code and text of a failed read; NOOK_OK if it succeeds.
struct Outcome {
  nook_result code = NOOK_OK;
  std::string text;
};

Outcome read_outcome(std::span<const std::byte> bytes) {
  try {
    check_model(read_character_model(bytes), NOOK_ERROR_INTERNAL);
  } catch (const Failure& failure) {
    return {failure.code(), failure.what()};
  }
  return {};
}

bool mentions(const Outcome& outcome, const char* part) {
  return outcome.text.find(part) != std::string::npos;
}

// Counts the bytes that a reader allocates.
class CountingMemory final : public nook::Memory {
 public:
  std::size_t total = 0;

 private:
  void* do_allocate(std::size_t size, std::size_t alignment) override {
    total += size;
    return nook::default_memory()->allocate(size, alignment);
  }
  void do_deallocate(void* memory, std::size_t size, std::size_t alignment) override {
    nook::default_memory()->deallocate(memory, size, alignment);
  }
};

bool is_equal(const Mat3x4& a, const Mat3x4& b) {
  return std::equal(a.m, a.m + 12, b.m);
}

// Bind data has floats, rest positions and normals are quantised.
void check_bind_data_is_equal(const CharacterModel& read, const CharacterModel& model) {
  REQUIRE(read.bind.bones.size() == model.bind.bones.size());
  for (std::size_t b = 0; b < model.bind.bones.size(); ++b) {
    CHECK(is_equal(read.bind.bones[b].node_from_rest, model.bind.bones[b].node_from_rest));
    CHECK(read.bind.bones[b].first_of_joint == model.bind.bones[b].first_of_joint);
  }
  REQUIRE(read.bind.rest_from_mesh.size() == model.bind.rest_from_mesh.size());
  for (std::size_t s = 0; s < model.bind.rest_from_mesh.size(); ++s)
    CHECK(is_equal(read.bind.rest_from_mesh[s], model.bind.rest_from_mesh[s]));
  CHECK(read.bind.primitive_space == model.bind.primitive_space);
  CHECK(read.bind.bone_of_joint == model.bind.bone_of_joint);
  REQUIRE(read.bind.skins.size() == model.bind.skins.size());
  for (std::size_t s = 0; s < model.bind.skins.size(); ++s) {
    CHECK(read.bind.skins[s].file_index == model.bind.skins[s].file_index);
    CHECK(read.bind.skins[s].space == model.bind.skins[s].space);
    CHECK(read.bind.skins[s].first_joint == model.bind.skins[s].first_joint);
    CHECK(read.bind.skins[s].joint_count == model.bind.skins[s].joint_count);
  }
  REQUIRE(read.bind.vertices.size() == model.bind.vertices.size());
  for (std::size_t v = 0; v < model.bind.vertices.size(); ++v) {
    CHECK(read.bind.vertices[v].file_vertex == model.bind.vertices[v].file_vertex);
    CHECK(read.bind.vertices[v].position == model.bind.vertices[v].position);
    CHECK(read.bind.vertices[v].bone == model.bind.vertices[v].bone);
    CHECK(read.bind.vertices[v].weight == model.bind.vertices[v].weight);
  }
  REQUIRE(read.rest.position.size() == model.rest.position.size());
  for (std::size_t i = 0; i < model.rest.position.size(); ++i) {
    // Half a step of 1 m / 65535 on three axes, and of an octahedron of 127 steps a side: 2 degrees.
    CHECK(length(read.rest.position[i] - model.rest.position[i]) < 1.4e-5f);
    CHECK(dot(read.rest.normal[i], model.rest.normal[i]) > 0.9994f);
  }
}

void put_u32(std::vector<std::byte>& file, std::size_t at, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) file[at + i] = std::byte(value >> (8 * i) & 255);
}

}  // namespace

TEST_CASE("a file of every kernel loads and keeps its form, also the rational one, which no bake makes") {
  for (const KernelForm form : {KernelForm::paper, KernelForm::nook, KernelForm::rational}) {
    CharacterModel model = test::sample_model(3, {40, 60, 90, 700, 200, 8});
    model.kernel.form = form;
    CHECK(quantise(model).kernel.form == form);
  }
}

TEST_CASE("a model comes back from its file within the steps of its codes") {
  const CharacterModel model = test::sample_model(3, {40, 60, 90, 700, 200, 8});
  const CharacterModel read = quantise(model);

  REQUIRE(read.bone_names == model.bone_names);
  REQUIRE(read.kernel.form == model.kernel.form);
  REQUIRE(read.kernel.gamma == model.kernel.gamma);
  REQUIRE(read.bounding_radius == model.bounding_radius);
  REQUIRE(read.recipe == model.recipe);
  REQUIRE(read.file_to_welded == model.file_to_welded);
  REQUIRE(read.primitives.size() == model.primitives.size());
  REQUIRE(read.spheres.size() == model.spheres.size());
  check_bind_data_is_equal(read, model);
  for (std::size_t i = 0; i < read.spheres.size(); ++i) {
    // Half a step of 0.8 m / 65535, on three axes.
    CHECK(length(read.spheres[i].centre - model.spheres[i].centre) < 1.1e-5f);
    CHECK(std::abs(read.spheres[i].radius - model.spheres[i].radius) < 1e-6f);
    CHECK(std::abs(read.spheres[i].caster_weight - model.spheres[i].caster_weight) < 0.9f / 255 / 2 + 1e-6f);
    CHECK(read.spheres[i].bone == model.spheres[i].bone);
  }
  for (std::size_t k = 0; k < read.key_points.size(); ++k) {
    const KeyPoint &got = read.key_points[k], &want = model.key_points[k];
    CHECK(length(got.position - want.position) < 1.4e-5f);
    // Both the position's step and the offset's, 0.04 m / 4095.
    CHECK(length(got.surface_position - want.surface_position) < 2.5e-5f);
    // Half a step h on two coordinates moves the point of the octahedron by at most sqrt(6) h, 1 / sqrt(3)
    // from the centre.
    CHECK(length(got.normal - want.normal) < 4.3f / 2047);
    CHECK(length(got.surface_normal - want.surface_normal) < 4.3f / 1023);
    float sum = 0;
    for (int b = 0; b < KeyPoint::max_bones; ++b) {
      sum += got.weight[b];
      // Largest remainders move a weight by less than one step.
      CHECK(std::abs(got.weight[b] - want.weight[b]) < 1.0f / 256);
    }
    CHECK(sum == 1.0f);
  }
  const float max_alpha = *std::ranges::max_element(model.alpha);
  for (std::size_t v = 0; v < read.vertex_count(); ++v) {
    float got_sum = 0, want_sum = 0;
    for (std::size_t e = v * 8; e < v * 8 + 8; ++e) {
      got_sum += read.alpha[e];
      want_sum += model.alpha[e];
      if (model.alpha[e] == 0) continue;
      // The order of a vertex's entries is the file's own.
      const auto* const first = &read.influence[v * 8];
      const auto place = static_cast<std::size_t>(std::find(first, first + 8, model.influence[e]) - first);
      REQUIRE(place < 8);
      // A step of the square-root code is at most 2 / 127 of the largest; errors passed on add at most one
      // more.
      CHECK(std::abs(read.alpha[v * 8 + place] - model.alpha[e]) < max_alpha * 2 / 127);
      // Half a sixteenth; the first one written takes up the rounding of all the others.
      CHECK(std::abs(read.blend[v * 8 + place] - model.blend[e]) <= (place == 0 ? 7 : 1) / 32.0f + 1e-6f);
    }
    CHECK(std::count_if(&read.alpha[v * 8], &read.alpha[v * 8] + 8, [](float a) { return a > 0; }) ==
          std::count_if(&model.alpha[v * 8], &model.alpha[v * 8] + 8, [](float a) { return a > 0; }));
    CHECK(std::abs(got_sum - want_sum) < max_alpha / 127);
    // Half a step of the range 0.3.
    CHECK(std::abs(read.bias[v] - model.bias[v]) < 0.3f / 255 / 2 + 1e-6f);
    CHECK(std::abs(read.static_ao[v] - model.static_ao[v]) < 0.5f / 255 + 1e-6f);
  }
}

TEST_CASE("world casters come back from a file within the steps of their codes, in few bytes") {
  CharacterModel model = test::sample_model(3, {40, 60, 90, 700, 200, 8});
  const std::size_t without = write_character_model(model).size();
  CHECK(quantise(model).world_casters.empty());
  test::Numbers numbers(8);
  test::add_world_casters(model, numbers);
  while (model.world_casters.size() < CharacterModel::max_world_casters)
    model.world_casters.push_back(model.world_casters[model.world_casters.size() % 40]);
  model.world_casters.resize(CharacterModel::max_world_casters);
  CHECK(write_character_model(model).size() - without <= 2048);
  const CharacterModel read = quantise(model);
  REQUIRE(read.world_casters.size() == model.world_casters.size());
  for (std::size_t i = 0; i < read.world_casters.size(); ++i) {
    const WorldCaster &got = read.world_casters[i], &want = model.world_casters[i];
    // Half a step of 1.4 m / 16383, on three axes; of 0.07 m / 4095; of 0.5 / 255.
    CHECK(length(got.capsule.a - want.capsule.a) < 8e-5f);
    CHECK(length(got.capsule.b - want.capsule.b) < 8e-5f);
    CHECK(std::abs(got.capsule.radius_a - want.capsule.radius_a) < 1e-5f);
    CHECK(std::abs(got.capsule.radius_b - want.capsule.radius_b) < 1e-5f);
    CHECK(std::abs(got.ao_scale - want.ao_scale) < 1.1e-3f);
    CHECK(got.bone == want.bone);
  }
  CHECK(write_character_model(read) == write_character_model(quantise(read)));
  model.world_casters.push_back(model.world_casters.front());
  CHECK_THROWS_AS(write_character_model(model), Failure);
  model.world_casters.pop_back();
  model.world_casters[3].bone = 40;
  CHECK_THROWS_AS(write_character_model(model), Failure);
  model.world_casters[3].bone = 0;
  model.world_casters[5].capsule.radius_b = 0;
  CHECK_THROWS_AS(write_character_model(model), Failure);
}

TEST_CASE("quantising twice changes nothing more") {
  const CharacterModel once = quantise(test::sample_model(5));
  CHECK(write_character_model(once) == write_character_model(quantise(once)));
}

TEST_CASE("a file stays within 16 bytes for each vertex and 16 KB, and 8 bytes for its rest position") {
  // The largest model of the product's tables, with 6 entries a vertex on average, 4 of them shared with the
  // vertex before; on real characters 4.3 of 6.7 entries are shared.
  CharacterModel model = test::sample_model(9, {80, 130, 500, 6000, 0, 8});
  for (std::size_t v = 0; v < model.vertex_count(); ++v)
    for (std::size_t e = 0; e < 8; ++e) {
      model.alpha[v * 8 + e] = e < 5 + v % 3 ? 0.1f : 0.0f;
      model.influence[v * 8 + e] = static_cast<std::uint16_t>((e < 4 ? v / 4 + e : 37 * v + 101 * e) % 500);
      model.blend[v * 8 + e] = e == 0 ? 1.0f : 0.0f;
    }
  model.recipe.assign(1024, ' ');
  const std::vector<std::byte> file = write_character_model(model);
  const std::size_t file_order = (model.file_to_welded.size() + 7) / 8 + 8;
  INFO(file.size());
  // 80 bones have 50 bytes of bind data each.
  CHECK(file.size() <= (16 + 8) * model.vertex_count() + 16384 + 80 * 50 + file_order);
}

TEST_CASE("welded vertices may be numbered in any order") {
  CharacterModel model = test::sample_model(2);
  std::ranges::reverse(model.file_to_welded);
  CHECK(quantise(model).file_to_welded == model.file_to_welded);
}

TEST_CASE("each fault of the container has a message of its own") {
  const std::vector<std::byte> good = write_character_model(test::sample_model());
  REQUIRE(read_outcome(good).code == NOOK_OK);

  CHECK(mentions(read_outcome({}), "too short"));
  auto file = good;
  file[0] = std::byte{'X'};
  CHECK(mentions(read_outcome(file), "not \"NOOK\""));
  file = good;
  put_u32(file, 4, 0x04030201);
  CHECK(mentions(read_outcome(file), "big-endian"));
  file = good;
  put_u32(file, 8, 7);
  CHECK(read_outcome(file).code == NOOK_ERROR_FILE_VERSION);
  CHECK(mentions(read_outcome(file), "got 7, need 4"));
  file = good;
  put_u32(file, 12, four_letters("NNAO"));
  CHECK(mentions(read_outcome(file), "got \"NNAO\", need \"CHAR\""));
  file = good;
  file.push_back({});
  CHECK(mentions(read_outcome(file), "size is wrong"));
  file = good;
  file.back() ^= std::byte{1};
  CHECK(mentions(read_outcome(file), "checksum"));
  file = good;
  put_u32(file, 40, four_letters("ODDS"));  // the first section's name
  repair_checksum(file);
  CHECK(mentions(read_outcome(file), "section HEAD is missing"));
  file = good;
  put_u32(file, 40 + 12, 0x7fffffff);  // the upper half of the first section's offset
  repair_checksum(file);
  CHECK(mentions(read_outcome(file), "outside the file"));
}

TEST_CASE("a file cut at any byte is refused") {
  const std::vector<std::byte> good = write_character_model(test::sample_model());
  for (std::size_t size = 0; size < good.size(); ++size) {
    // An exact copy on the heap, so that the address sanitizer sees one byte too far.
    const std::vector<std::byte> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
    REQUIRE(read_outcome(cut).code == NOOK_ERROR_BAD_FILE);
  }
}

TEST_CASE("a file flipped at any byte is refused") {
  const std::vector<std::byte> good = write_character_model(test::sample_model());
  for (std::size_t i = 0; i < good.size(); ++i) {
    auto file = good;
    file[i] ^= std::byte{0x81};
    REQUIRE(read_outcome(file).code != NOOK_OK);
  }
}

TEST_CASE("a file flipped at any byte with its checksum repaired loads soundly or is refused") {
  const std::vector<std::byte> good = write_character_model(test::sample_model());
  std::size_t refused = 0;
  for (std::size_t i = 0; i < good.size(); ++i)
    for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
      auto file = good;
      file[i] ^= std::byte(flip);
      repair_checksum(file);
      const Outcome outcome = read_outcome(file);
      refused += outcome.code != NOOK_OK;
      REQUIRE((outcome.code == NOOK_OK || outcome.code == NOOK_ERROR_BAD_FILE ||
               outcome.code == NOOK_ERROR_FILE_VERSION));
    }
  // Heads, tables and counts are a good part of so small a file.
  CHECK(refused > good.size() / 2);
}

TEST_CASE("memory for a hostile file is bounded by its size") {
  const std::vector<std::byte> good = write_character_model(test::sample_model());
  for (std::size_t i = 40; i < good.size(); ++i) {
    auto file = good;
    file[i] ^= std::byte{0xff};
    repair_checksum(file);
    CountingMemory memory;
    try {
      read_character_model(file, &memory);
    } catch (const Failure&) {
    }
    // 19 bits of the linear layer become at most 48 bytes of arrays: a factor of 20; names and the rest stay
    // below.
    REQUIRE(memory.total < 64 * file.size());
  }
}

TEST_CASE("a model with a fault is not written, and the message names it") {
  const auto refusal = [](auto&& damage) {
    CharacterModel model = test::sample_model();
    damage(model);
    try {
      write_character_model(model);
    } catch (const Failure& failure) {
      REQUIRE(failure.code() == NOOK_ERROR_INVALID_ARGUMENT);
      return std::string(failure.what());
    }
    return std::string();
  };
  const auto has = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  CHECK(has(refusal([](CharacterModel& m) { m.spheres.clear(); }), "number of spheres"));
  CHECK(has(refusal([](CharacterModel& m) { m.spheres[2].centre.y = NAN; }), "centre of sphere 2"));
  CHECK(has(refusal([](CharacterModel& m) { m.spheres[1].radius = 0; }), "radius of sphere 1"));
  CHECK(has(refusal([](CharacterModel& m) { m.spheres[3].bone = 5; }), "bone of sphere 3"));
  CHECK(has(refusal([](CharacterModel& m) { m.key_points[4].normal = {}; }), "normal of key point 4"));
  CHECK(has(refusal([](CharacterModel& m) { m.key_points[4].weight[0] += 0.5f; }), "key point 4"));
  CHECK(has(refusal([](CharacterModel& m) { m.influence[0] = 12; }), "key point of vertex 0"));
  CHECK(has(refusal([](CharacterModel& m) { m.alpha[0] = -1; }), "alpha of vertex 0"));
  CHECK(
      has(refusal([](CharacterModel& m) { std::ranges::fill(m.alpha, 0.0f); }), "sum of alphas of vertex 0"));
  CHECK(has(refusal([](CharacterModel& m) { m.bias[7] = INFINITY; }), "bias of vertex 7"));
  CHECK(has(refusal([](CharacterModel& m) { m.file_to_welded[1] = 40; }), "file vertex 1"));
  CHECK(has(refusal([](CharacterModel& m) { m.primitives.pop_back(); }), "file vertices"));
  CHECK(has(refusal([](CharacterModel& m) { m.kernel.gamma = 0.5f; }), "gamma"));
  CHECK(has(refusal([](CharacterModel& m) { m.root_bone = 5; }), "root bone"));
  CHECK(has(refusal([](CharacterModel& m) { m.influences = 9; }), "influences"));
}

TEST_CASE("a model without bind data writes a file without its sections and reads it back") {
  CharacterModel model = test::sample_model();
  const std::size_t with = write_character_model(model).size();
  model.bind = BindData();
  model.rest = RestSurface();
  const auto bytes = write_character_model(model);
  CHECK(bytes.size() + 1000 < with);
  const CharacterModel read = read_character_model(bytes);
  CHECK(read.bind.empty());
  CHECK(read.rest.position.empty());
}

TEST_CASE("files of version 2, which have no bind data, are read") {
  CharacterModel model = test::sample_model();
  model.bind = BindData();
  model.rest = RestSurface();
  auto bytes = write_character_model(model);
  REQUIRE(bytes[8] == std::byte{4});
  bytes[8] = std::byte{2};
  repair_checksum(bytes);
  const CharacterModel read = read_character_model(bytes);
  CHECK(read.bind.empty());
  CHECK(read.vertex_count() == model.vertex_count());
}

TEST_CASE("a file whose largest saturation is out of range is refused") {
  const CharacterModel model = test::sample_model();
  const auto bytes = write_character_model(model);
  const float root = std::sqrt(max_saturation_of(model));
  std::byte code[sizeof root];
  std::memcpy(code, &root, sizeof root);
  const auto at = std::search(bytes.begin(), bytes.end(), std::begin(code), std::end(code));
  REQUIRE(at != bytes.end());
  for (const float wrong : {-1.0f, 8.1f, NAN}) {
    auto spoiled = bytes;
    std::memcpy(&spoiled[std::size_t(at - bytes.begin())], &wrong, sizeof wrong);
    repair_checksum(spoiled);
    try {
      read_character_model(spoiled);
      FAIL("a root of " << wrong << " passed");
    } catch (const Failure& failure) {
      CHECK(failure.code() == NOOK_ERROR_BAD_FILE);
      CHECK(std::string(failure.what()).find("largest saturation") != std::string::npos);
    }
  }
}

TEST_CASE("files of version 3, which have no saturations, are read as unsaturated") {
  CharacterModel model = test::sample_model();
  for (KeyPoint& point : model.key_points) point.saturation = 0;
  auto bytes = write_character_model(model);
  REQUIRE(bytes[8] == std::byte{4});
  bytes[8] = std::byte{3};
  repair_checksum(bytes);
  for (const KeyPoint& point : read_character_model(bytes).key_points) CHECK(point.saturation == 0);
}

TEST_CASE("saturations keep half a step of their roots, and those out of range are refused by name") {
  CharacterModel model = test::sample_model();
  const float most = max_saturation_of(model);
  REQUIRE(most > 0);
  const CharacterModel read = quantise(model);
  for (std::size_t k = 0; k < model.key_points.size(); ++k)
    CHECK(std::abs(std::sqrt(read.key_points[k].saturation) - std::sqrt(model.key_points[k].saturation)) <=
          0.5f / 255 * std::sqrt(most) * 1.001f);  // the rounding of floats is far below a thousandth of it
  for (const float wrong : {-0.5f, 65.0f, NAN}) {
    model.key_points[1].saturation = wrong;
    try {
      check_model(model, NOOK_ERROR_BAD_FILE);
      FAIL("a saturation of " << wrong << " passed");
    } catch (const Failure& failure) {
      CHECK(std::string(failure.what()).find("saturation of key point 1") != std::string::npos);
    }
  }
}

TEST_CASE("close vertices come back to the bit, and a model without them has no section for them") {
  CharacterModel model = test::sample_model();
  const std::vector<std::byte> bytes = write_character_model(model);
  const CharacterModel read = read_character_model(bytes);
  REQUIRE(read.bind.close.size() == model.bind.close.size());
  for (std::size_t v = 0; v < read.bind.close.size(); ++v) {
    const CloseVertex &is = read.bind.close[v], &was = model.bind.close[v];
    CHECK(is.welded == was.welded);
    CHECK(is.space == was.space);
    CHECK(is.mesh_position == was.mesh_position);
    REQUIRE(is.weights.count == was.weights.count);
    for (std::uint32_t b = 0; b < is.weights.count; ++b) {
      CHECK(is.weights.bone[b] == was.weights.bone[b]);
      // Half a step of 16 bits for each of up to three weights.
      CHECK(std::abs(is.weights.weight[b] - was.weights.weight[b]) <= 3 * 0.5f / 65535);
    }
  }
  CHECK(Container(bytes, character_kind).has("NEAR"));
  model.bind.close.clear();
  const std::vector<std::byte> without = write_character_model(model);
  CHECK(!Container(without, character_kind).has("NEAR"));
}

TEST_CASE("bind data with faults is refused by name") {
  const auto refusal = [](auto&& spoil) {
    CharacterModel model = test::sample_model();
    spoil(model);
    try {
      check_model(model, NOOK_ERROR_BAD_FILE);
    } catch (const Failure& failure) {
      return std::string(failure.what());
    }
    return std::string();
  };
  const auto names = [&](auto&& spoil, const char* part) {
    const std::string text = refusal(spoil);
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  names([](CharacterModel& m) { m.bind.bones[2].node_from_rest = Mat3x4{{0}}; }, "bind matrix of bone 2");
  names([](CharacterModel& m) { m.bind.bones[1].node_from_rest.m[3] = NAN; }, "bind matrix of bone 1");
  names([](CharacterModel& m) { m.bind.bones[1].first_of_joint = 4; }, "first bone of the joint of bone 1");
  names([](CharacterModel& m) { m.bind.bones.pop_back(); }, "bind matrices");
  names([](CharacterModel& m) { m.bind.primitive_space[1] = 2; }, "space of primitive 1");
  names([](CharacterModel& m) { m.bind.skins[0].space = 9; }, "space of skin 0");
  names([](CharacterModel& m) { m.bind.skins[1].joint_count = 2; }, "joints of skin 1");
  names([](CharacterModel& m) { m.bind.bone_of_joint[0] = 5; }, "bone of joint 0");
  names([](CharacterModel& m) { m.bind.vertices[3].weight[0] = 0.3f; }, "rest vertex 3");
  names([](CharacterModel& m) { m.bind.vertices[3].file_vertex = 1 << 20; }, "file vertex of rest vertex 3");
  names([](CharacterModel& m) { m.bind.vertices[0].bone_count = 0; }, "bone count of rest vertex 0");
  names([](CharacterModel& m) { m.bind.close[2].welded = 1 << 20; }, "welded vertex of close vertex 2");
  names([](CharacterModel& m) { m.bind.close[2].space = 2; }, "space of close vertex 2");
  names([](CharacterModel& m) { m.bind.close[2].mesh_position.y = NAN; }, "position of close vertex 2");
  names([](CharacterModel& m) { m.bind.close[1].weights.bone[0] = 5; }, "bone of close vertex 1");
  names([](CharacterModel& m) { m.bind.close[1].weights.weight[0] = NAN; }, "bone weight of close vertex 1");
  names([](CharacterModel& m) { m.bind.close[5].weights.weight[0] = 0; },
        "sum of bone weights of close vertex 5");
  names([](CharacterModel& m) { m.bind.close[1].weights.count = 9; }, "bone count of close vertex 1");
  names([](CharacterModel& m) { m.rest.normal[4] = {}; }, "rest normal of vertex 4");
  names([](CharacterModel& m) { m.rest.position.pop_back(); }, "rest positions");
}
