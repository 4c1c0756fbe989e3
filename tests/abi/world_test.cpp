// AO and light at points through the public interface.
#include <nook/experimental/nook_world_sample.h>
#include <nook/nook_world.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sdk/src/character/model_file.h"
#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook;
using namespace nook::test;

namespace {

CharacterModel casting_model() {
  CharacterModel model = sample_model();
  Numbers numbers(6);
  add_world_casters(model, numbers);
  return model;
}

// A scene with two instances of a model with casters, two metres apart, and points on a plane below them.
struct WorldStage {
  explicit WorldStage(float cutoff_error = 0, const CharacterModel& of = casting_model()) {
    host.bytes = write_character_model(of);
    const nook_context_desc desc = host.context_desc();
    REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, host.bytes.data(), host.bytes.size(), &model) == NOOK_OK);
    nook_scene_desc scene_desc = Host::scene_desc();
    scene_desc.cutoff_error = cutoff_error;
    REQUIRE(nook_scene_create(context, &scene_desc, &scene) == NOOK_OK);
    bones = std::uint32_t(of.bone_count());
    for (const float x : {-1.0f, 1.0f}) {
      nook_instance_id id = 0;
      REQUIRE(nook_scene_add_instance(scene, model, &id) == NOOK_OK);
      place(id, x);
      ids.push_back(id);
    }
    for (int z = -8; z < 8; ++z)
      for (int x = -20; x < 20; ++x) {
        positions.insert(positions.end(), {0.1f * float(x) + 0.05f, -0.9f, 0.1f * float(z) + 0.05f});
        normals.insert(normals.end(), {0, 1, 0});
      }
  }
  ~WorldStage() {
    nook_scene_destroy(&scene);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  WorldStage(const WorldStage&) = delete;
  WorldStage& operator=(const WorldStage&) = delete;

  nook_result place(nook_instance_id id, float x) {
    std::vector<float> pose;
    for (std::uint32_t b = 0; b < bones; ++b) pose.insert(pose.end(), {1, 0, 0, x, 0, 1, 0, 0, 0, 0, 1, 0});
    return nook::test::set_rows(scene, id, pose.data(), bones);
  }
  nook_world_sample_desc desc() const {
    nook_world_sample_desc d;
    REQUIRE(nook_world_sample_desc_init(&d) == NOOK_OK);
    d.positions = positions.data();
    d.normals = normals.data();
    d.point_count = std::uint32_t(positions.size() / 3);
    return d;
  }
  std::vector<float> ao(const nook_world_sample_desc& d) const {
    std::vector<float> values(d.point_count, -1.0f);
    REQUIRE(nook_world_sample(scene, &d, values.data(), nullptr) == NOOK_OK);
    return values;
  }

  Host host;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  std::uint32_t bones = 0;
  std::vector<nook_instance_id> ids;
  std::vector<float> positions, normals;
};

float darkest(const std::vector<float>& ao) {
  float least = 1;
  for (const float value : ao) least = std::min(least, value);
  return least;
}

}  // namespace

TEST_CASE("world: the bodies of a scene darken AO, a light and lobes at one point") {
  const WorldStage stage;
  const float position[3] = {-1, -0.9f, 0}, normal[3] = {0, 1, 0};
  const nook_lobe lobe{{0, 1, 0}, 2, {1, 1, 1}, 0};
  float ao = -1, light = -1, rgb[3] = {-1, -1, -1};
  nook_world_sample_desc desc = stage.desc();
  desc.positions = position;
  desc.normals = normal;
  desc.point_count = 1;
  desc.light_axis[1] = 1;
  desc.light_degrees = 20;
  desc.lobes = &lobe;
  desc.lobe_count = 1;
  desc.directional_ao = rgb;
  REQUIRE(nook_world_sample(stage.scene, &desc, &ao, &light) == NOOK_OK);
  CHECK((ao > 0 && ao < 1));
  CHECK((light >= 0 && light < 1));
  CHECK((rgb[0] > 0 && rgb[0] < 1));
}

TEST_CASE("world: a sphere over a plane has its closed form") {
  const float position[3] = {0.3f, 0, 0}, normal[3] = {0, 1, 0};
  const nook_capsule sphere = {{0, 0.5f, 0}, 0.2f, {0, 0.5f, 0}, 0.2f};
  nook_world_sample_desc desc;
  REQUIRE(nook_world_sample_desc_init(&desc) == NOOK_OK);
  desc.positions = position;
  desc.normals = normal;
  desc.point_count = 1;
  desc.capsules = &sphere;
  desc.capsule_count = 1;
  float ao = 0;
  REQUIRE(nook_world_sample(nullptr, &desc, &ao, nullptr) == NOOK_OK);
  const double distance2 = 0.3 * 0.3 + 0.5 * 0.5;
  // Of the arc cosine, see tests/world/coverage_test.cpp.
  CHECK(std::abs(double(ao) - (1 - 0.04 / distance2 * 0.5 / std::sqrt(distance2))) < 1e-4);
}

TEST_CASE("world: bodies, occluders and props multiply, and the receiver is left out") {
  WorldStage stage;
  const nook_world_sample_desc desc = stage.desc();
  const std::vector<float> both = stage.ao(desc);
  CHECK(darkest(both) < 0.97f);
  nook_world_sample_desc for_first = desc, for_second = desc;
  for_first.receiver = stage.ids[0];
  for_second.receiver = stage.ids[1];
  const std::vector<float> second = stage.ao(for_first), first = stage.ao(for_second);
  nook_occluder ball{{0, -0.5f, 0}, 0.2f, 0};
  const nook_capsule prop = {{0, -0.5f, 0}, 0.2f, {0, -0.5f, 0}, 0.2f};
  nook_world_sample_desc with_prop = desc;
  with_prop.capsules = &prop;
  with_prop.capsule_count = 1;
  const std::vector<float> propped = stage.ao(with_prop);
  nook_occluder_id occluder = 0;
  REQUIRE(nook_scene_add_occluder(stage.scene, &ball, &occluder) == NOOK_OK);
  const std::vector<float> occluded = stage.ao(desc);
  ball.receiver = stage.ids[0];
  REQUIRE(nook_scene_set_occluder(stage.scene, occluder, &ball) == NOOK_OK);
  const std::vector<float> limited = stage.ao(desc), as_receiver = stage.ao(for_first);
  nook_world_sample_desc alone = for_first;
  alone.capsules = &prop;
  alone.capsule_count = 1;
  REQUIRE(nook_scene_remove_occluder(stage.scene, occluder) == NOOK_OK);
  const std::vector<float> second_with_prop = stage.ao(alone);
  for (std::size_t i = 0; i < both.size(); ++i) {
    CHECK(std::abs(both[i] - first[i] * second[i]) < 1e-5f);
    CHECK(std::abs(propped[i] - occluded[i]) < 1e-6f);
    CHECK(limited[i] == both[i]);
    CHECK(std::abs(as_receiver[i] - second_with_prop[i]) < 1e-6f);
  }
}

TEST_CASE("world: a body follows its pose without an update, and none darkens after it is removed") {
  WorldStage stage;
  const nook_world_sample_desc desc = stage.desc();
  const std::vector<float> before = stage.ao(desc);
  REQUIRE(stage.place(stage.ids[0], -1.3f) == NOOK_OK);
  CHECK(stage.ao(desc) != before);
  REQUIRE(stage.place(stage.ids[0], -1) == NOOK_OK);
  CHECK(stage.ao(desc) == before);
  // A pose that is not finite is refused, and changes nothing.
  CHECK(stage.place(stage.ids[0], NAN) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(stage.ao(desc) == before);
  for (const nook_instance_id id : stage.ids) REQUIRE(nook_scene_remove_instance(stage.scene, id) == NOOK_OK);
  for (const float value : stage.ao(desc)) CHECK(value == 1);
}

TEST_CASE("world: a body that is left out at a point reduces AO there by less than the cut-off") {
  constexpr float cutoff = 0.05f;
  WorldStage whole, cut(cutoff);
  // Rows that are farther apart, so that blocks of points lie at several distances.
  for (WorldStage* stage : {&whole, &cut})
    for (std::size_t i = 2; i < stage->positions.size(); i += 3) stage->positions[i] *= 8;
  const std::vector<float> all = whole.ao(whole.desc()), some = cut.ao(cut.desc());
  int changed = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CHECK(some[i] >= all[i] - 1e-6f);
    CHECK(some[i] - all[i] <= 2 * cutoff);
    changed += some[i] != all[i];
  }
  CHECK(changed > 0);
}

TEST_CASE("world: points that are not finite are open, and do not disturb others") {
  WorldStage stage;
  const std::vector<float> before = stage.ao(stage.desc());
  stage.positions[3 * 5] = NAN;
  stage.normals[3 * 9 + 1] = INFINITY;
  const std::vector<float> after = stage.ao(stage.desc());
  for (std::size_t i = 0; i < after.size(); ++i) CHECK(after[i] == (i == 5 || i == 9 ? 1 : before[i]));
}

TEST_CASE("world: strided positions and normals give the same AO, and sampling does not allocate") {
  WorldStage stage;
  nook_world_sample_desc desc = stage.desc();
  const std::vector<float> before = stage.ao(desc);
  std::vector<float> loose;
  for (std::size_t i = 0; i < stage.positions.size(); i += 3)
    for (const std::vector<float>* of : {&stage.positions, &stage.normals})
      loose.insert(loose.end(), of->begin() + std::ptrdiff_t(i), of->begin() + std::ptrdiff_t(i) + 3);
  desc.positions = loose.data();
  desc.normals = loose.data() + 3;
  desc.stride = 6 * sizeof(float);
  const int allocations = stage.host.allocations;
  CHECK(stage.ao(desc) == before);
  CHECK(stage.host.allocations == allocations);
}

TEST_CASE("world: a light is hidden behind a body and open aside") {
  const float position[6] = {0, 0, 0, 3, 0, 0}, normal[6] = {0, 1, 0, 0, 1, 0};
  const nook_capsule prop = {{-0.5f, 1, 0}, 0.4f, {0.5f, 1, 0}, 0.4f};
  nook_world_sample_desc desc;
  REQUIRE(nook_world_sample_desc_init(&desc) == NOOK_OK);
  desc.positions = position;
  desc.normals = normal;
  desc.point_count = 2;
  desc.capsules = &prop;
  desc.capsule_count = 1;
  desc.light_axis[1] = 1;
  desc.light_degrees = 20;
  float light[2] = {-1, -1};
  REQUIRE(nook_world_sample(nullptr, &desc, nullptr, light) == NOOK_OK);
  CHECK(light[0] < 1e-6f);
  CHECK(light[1] == 1);
}

TEST_CASE("world: a model without casters is refused by name, and casts nothing") {
  WorldStage stage(0, sample_model());
  std::uint32_t count = 7;
  CHECK(nook_model_read_capsules(stage.model, nullptr, &count) == NOOK_ERROR_UNSUPPORTED);
  CHECK(std::string(nook_last_message()).find("bake the character again") != std::string::npos);
  CHECK(count == 0);
  for (const float value : stage.ao(stage.desc())) CHECK(value == 1);
}

TEST_CASE("world: bad input is refused with the field's name") {
  WorldStage stage;
  float out = 0;
  const auto refused = [&](nook_result code, const char* text, auto&& change) {
    nook_world_sample_desc desc = stage.desc();
    change(desc);
    CHECK(nook_world_sample(stage.scene, &desc, &out, nullptr) == code);
    INFO(nook_last_message());
    CHECK(std::string(nook_last_message()).find(text) != std::string::npos);
  };
  const nook_result invalid = NOOK_ERROR_INVALID_ARGUMENT;
  refused(invalid, "desc.positions", [](auto& d) { d.positions = nullptr; });
  refused(invalid, "desc.normals", [](auto& d) { d.normals = nullptr; });
  refused(invalid, "desc.stride", [](auto& d) { d.stride = 8; });
  refused(invalid, "desc.stride", [](auto& d) { d.stride = 13; });
  refused(invalid, "desc.capsules is NULL", [](auto& d) { d.capsule_count = 2; });
  refused(invalid, "desc.light_degrees", [](auto& d) { d.light_degrees = 179; });
  refused(invalid, "desc.light_degrees", [](auto& d) { d.light_degrees = NAN; });
  refused(invalid, "desc.light_axis", [](auto& d) { d.light_degrees = 5; });
  float rgb[3];
  refused(invalid, "desc.lobes is NULL", [&](auto& d) {
    d.directional_ao = rgb;
    d.lobe_count = 1;
  });
  nook_lobe lobe{};
  refused(invalid, "the axis of lobe 0", [&](auto& d) {
    d.directional_ao = rgb;
    d.lobes = &lobe;
    d.lobe_count = 1;
  });
  refused(NOOK_ERROR_INVALID_HANDLE, "no instance", [](auto& d) { d.receiver = 77; });
  const nook_capsule bad[] = {{{0, 0, 0}, 0, {0, 0, 0}, 1}, {{NAN, 0, 0}, 1, {0, 0, 0}, 1}};
  for (const nook_capsule& prop : bad)
    refused(invalid, "desc.capsules[0]", [&](auto& d) {
      d.capsules = &prop;
      d.capsule_count = 1;
    });
  nook_world_sample_desc lit = stage.desc();
  lit.point_count = 1;
  CHECK(nook_world_sample(stage.scene, &lit, nullptr, &out) == invalid);
  CHECK(nook_world_sample(stage.scene, nullptr, &out, nullptr) == invalid);
  lit.type = 0;
  CHECK(nook_world_sample(stage.scene, &lit, &out, nullptr) == invalid);
  std::uint32_t count = 1;
  nook_model_capsule caster;
  CHECK(nook_model_read_capsules(stage.model, &caster, &count) == invalid);
  CHECK(nook_model_read_capsules(nullptr, &caster, &count) == invalid);
  CHECK(nook_model_read_capsules(stage.model, nullptr, nullptr) == invalid);
}

TEST_CASE("world: every refused allocation of an instance with casters leaves the scene as it was") {
  WorldStage stage;
  const int blocks = stage.host.blocks;
  nook_instance_id id = 0;
  int refusals = 0;
  for (int n = 0; n < 100; ++n) {
    stage.host.refuse_at = stage.host.allocations + n;
    const nook_result result = nook_scene_add_instance(stage.scene, stage.model, &id);
    stage.host.refuse_at = -1;
    if (result == NOOK_OK) break;
    ++refusals;
    CHECK(result == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(stage.host.blocks <= blocks + 1);  // room for a slot may stay
  }
  CHECK(refusals >= 2);
}
