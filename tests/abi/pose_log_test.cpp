// The log and nook_scene_info name poses that are taken but are unlikely to be meant: uneven bones,
// zeros, more transforms than needed.
#include <nook/nook_clips.h>

#include <array>
#include <cmath>
#include <string>

#include "sdk/src/character/clip_set.h"
#include "tests/abi/host.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"

using namespace nook::test;

namespace {

using Rows = std::array<float, 12>;

// A context that keeps its log, beside the model of Stage.
struct LogStage {
  explicit LogStage(std::uint32_t strict = 0) {
    nook_context_desc desc = stage.host.context_desc();
    desc.log_user = this;
    desc.log = [](void* user, nook_log_severity severity, const char* text) {
      LogStage& self = *static_cast<LogStage*>(user);
      (severity == NOOK_LOG_WARNING ? self.warnings : self.infos).push_back(text);
    };
    nook_scene_desc scene_desc = Host::scene_desc();
    scene_desc.strict_poses = strict;
    REQUIRE(nook_context_create(&desc, &context) == NOOK_OK);
    REQUIRE(nook_model_load(context, stage.host.bytes.data(), stage.host.bytes.size(), &model) == NOOK_OK);
    REQUIRE(nook_scene_create(context, &scene_desc, &scene) == NOOK_OK);
    for (nook_instance_id& id : ids) REQUIRE(nook_scene_add_instance(scene, model, &id) == NOOK_OK);
    infos.clear();
  }
  ~LogStage() {
    nook_scene_destroy(&scene);
    nook_model_destroy(&model);
    nook_context_destroy(&context);
  }
  LogStage(const LogStage&) = delete;
  LogStage& operator=(const LogStage&) = delete;

  std::uint32_t uneven_instances() const {
    nook_scene_info info{};
    info.struct_size = sizeof info;
    REQUIRE(nook_scene_describe(scene, &info) == NOOK_OK);
    return info.uneven_instances;
  }

  Stage stage;
  nook_context context = nullptr;
  nook_model model = nullptr;
  nook_scene scene = nullptr;
  nook_instance_id ids[2] = {0, 0};
  std::vector<std::string> warnings, infos;
};

bool has(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

// A transform for each bone in a layout of matrices.
std::vector<float> in_layout(const std::vector<Rows>& rows, nook_transform_layout layout) {
  std::vector<float> out;
  for (const Rows& m : rows) {
    const bool is_square = layout == NOOK_TRANSFORM_ROWS_4X4 || layout == NOOK_TRANSFORM_COLUMNS_4X4;
    if (layout == NOOK_TRANSFORM_ROWS_3X4 || layout == NOOK_TRANSFORM_ROWS_4X4) {
      out.insert(out.end(), m.begin(), m.end());
      if (is_square) out.insert(out.end(), {0, 0, 0, 1});
      continue;
    }
    for (std::size_t column = 0; column < 4; ++column) {
      for (std::size_t row = 0; row < 3; ++row) out.push_back(m[4 * row + column]);
      if (is_square) out.push_back(column == 3 ? 1.0f : 0.0f);
    }
  }
  return out;
}

constexpr Rows identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

struct Fault {
  const char* name;
  Rows matrix;
  const char* lengths;  // of the axes, as the message has them
};
const Fault faults[] = {
    {"scaled unevenly", {1, 0, 0, 0, 0, 1.5f, 0, 0, 0, 0, 1, 0}, "1 1.5 1"},
    {"sheared", {1, 0.75f, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, "1 1.25 1"},
    {"without one axis", {1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0}, "1 0 1"},
    {"without two axes", {0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0}, "0 2 0"},
    {"without any axis", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "0 0 0"},
    {"mirrored and scaled unevenly", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1.5f, 0}, "1 1 1.5"},
};

}  // namespace

TEST_CASE("an uneven bone is logged once for an instance with its axes, whatever the call's form") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const nook_pose_kind kind = GENERATE(range(int{NOOK_POSE_REST_TO_WORLD}, NOOK_POSE_SKINNING + 1));
  const nook_transform_layout layout =
      GENERATE(range(int{NOOK_TRANSFORM_ROWS_3X4}, NOOK_TRANSFORM_COLUMNS_4X3 + 1));
  const Fault& fault = faults[GENERATE(range(0, 6))];
  const bool is_placed = GENERATE(false, true), is_mapped = GENERATE(false, true);
  INFO("kind " << kind << ", layout " << layout << ", " << fault.name << (is_placed ? ", placed" : "")
               << (is_mapped ? ", mapped" : ""));
  std::vector<Rows> rows(count, identity);
  const std::vector<float> good = in_layout(rows, layout);
  rows[2] = fault.matrix;
  const std::vector<float> bad = in_layout(rows, layout);
  std::vector<std::int32_t> map;
  for (std::uint32_t b = 0; b < count; ++b) map.push_back(static_cast<std::int32_t>(b));
  nook_pose_desc desc;
  REQUIRE(nook_pose_desc_init(&desc) == NOOK_OK);
  desc.kind = kind;
  desc.layout = layout;
  desc.skin = 1;
  desc.transform_count = count;
  desc.transforms = bad.data();
  const float place[12] = {0, 0, 1, 3, 0, 1, 0, 2, -1, 0, 0, 1};
  if (is_placed) desc.place_3x4 = place;
  if (is_mapped) {
    desc.transform_of_bone = map.data();
    desc.bone_count = count;
  }
  for (int frame = 0; frame < 3; ++frame)
    for (const nook_instance_id id : log.ids) CHECK(nook_scene_set_pose(log.scene, id, &desc) == NOOK_OK);
  REQUIRE(log.warnings.size() == 2);
  // The skin's joints are the bones from the last on, so that the middle one stays. The bind data of the
  // sample turn axes and scale by 0.01, so that only Nook's own matrices have the lengths of the given
  // matrix.
  for (const std::string& line : log.warnings) {
    INFO(line);
    CHECK(has(line, "bone 2 "));
    if (kind == NOOK_POSE_REST_TO_WORLD) CHECK(has(line, fault.lengths));
  }
  CHECK(has(log.warnings[0], ("instance " + std::to_string(log.ids[0])).c_str()));
  CHECK(log.uneven_instances() == 2);

  desc.transforms = good.data();
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.uneven_instances() == 1);
  std::vector<float> bones(12 * std::size_t(count));
  desc.transforms = bad.data();
  for (int i = 0; i < 2; ++i)
    CHECK(nook_model_convert_pose(log.model, &desc, bones.data(), count) == NOOK_OK);
  CHECK(log.warnings.size() == 3);
  desc.flags = NOOK_POSE_FLAG_STRICT;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(has(nook_last_message(), "bone 2 "));
  CHECK(log.uneven_instances() == 1);
}

TEST_CASE("1 % of unevenness passes and 1.1 % is named, in every form of the call") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const float share = GENERATE(0.0f, 0.0099f, 0.0111f);
  const bool is_placed = GENERATE(false, true);  // the converted form
  std::vector<Rows> rows(count, identity);
  rows[3][10] = 1 + share;
  nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  const float place[12] = {1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0};
  if (is_placed) desc.place_3x4 = place;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.warnings.size() == (share > 0.01f ? 1u : 0u));
  CHECK(log.uneven_instances() == (share > 0.01f ? 1u : 0u));
  desc.flags = NOOK_POSE_FLAG_STRICT;
  CHECK((nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK) == (share < 0.01f));
}

TEST_CASE("a partial pose leaves what it does not set uneven") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  std::vector<Rows> rows(count, identity);
  rows[1] = faults[0].matrix;
  nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.uneven_instances() == 1);
  rows[1] = identity;
  std::vector<std::int32_t> map(count, -1);
  desc.transform_of_bone = map.data();
  desc.bone_count = count;
  desc.flags = NOOK_POSE_FLAG_PARTIAL;
  map[0] = 0;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.uneven_instances() == 1);
  map[1] = 1;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.uneven_instances() == 0);
}

TEST_CASE("an uneven place is named as the cause") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const std::vector<Rows> rows(count, identity);
  nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  const float place[12] = {1, 0, 0, 0, 0, 1.3f, 0, 0, 0, 0, 1, 0};
  desc.place_3x4 = place;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  REQUIRE(log.warnings.size() == 1);
  INFO(log.warnings[0]);
  CHECK(has(log.warnings[0], "place_3x4"));
  CHECK(has(log.warnings[0], (std::to_string(count) + " of " + std::to_string(count)).c_str()));
}

TEST_CASE("a pose of zeros alone is logged once for an instance") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const std::vector<float> zeros(16 * std::size_t(count), 0.0f);
  nook_pose_desc desc;
  REQUIRE(nook_pose_desc_init(&desc) == NOOK_OK);
  desc.kind = GENERATE(range(int{NOOK_POSE_REST_TO_WORLD}, NOOK_POSE_SKINNING + 1));
  desc.layout = GENERATE(int{NOOK_TRANSFORM_ROWS_3X4}, int{NOOK_TRANSFORM_COLUMNS_4X4});
  desc.skin = 1;
  desc.transform_count = count;
  desc.transforms = zeros.data();
  for (int frame = 0; frame < 2; ++frame)
    for (const nook_instance_id id : log.ids) CHECK(nook_scene_set_pose(log.scene, id, &desc) == NOOK_OK);
  REQUIRE(log.warnings.size() == 2);
  CHECK(has(log.warnings[0], "are zero"));
  CHECK(nook_scene_update(log.scene) == NOOK_OK);
}

TEST_CASE("more transforms than needed are taken with a flag, and logged once with both numbers") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const nook_pose_kind kind = GENERATE(range(int{NOOK_POSE_REST_TO_WORLD}, NOOK_POSE_SKINNING + 1));
  const nook_transform_layout layout =
      GENERATE(int{NOOK_TRANSFORM_ROWS_3X4}, int{NOOK_TRANSFORM_COLUMNS_4X4});
  std::vector<Rows> rows(128, identity);
  for (std::size_t b = 0; b < rows.size(); ++b) rows[b][3] = float(b);
  for (std::size_t b = count; b < rows.size(); ++b) rows[b][5] = NAN;  // never read
  const std::vector<float> given = in_layout(rows, layout);
  nook_pose_desc desc;
  REQUIRE(nook_pose_desc_init(&desc) == NOOK_OK);
  desc.kind = kind;
  desc.layout = layout;
  desc.skin = 1;
  desc.transforms = given.data();
  desc.transform_count = count;
  std::vector<float> exact(12 * std::size_t(count)), surplus(exact.size());
  REQUIRE(nook_model_convert_pose(log.model, &desc, exact.data(), count) == NOOK_OK);
  desc.transform_count = 128;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(has(nook_last_message(), "NOOK_POSE_FLAG_SURPLUS"));
  desc.flags = NOOK_POSE_FLAG_SURPLUS;
  for (int frame = 0; frame < 3; ++frame) CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  CHECK(log.warnings.empty());
  REQUIRE(log.infos.size() == 1);
  INFO(log.infos[0]);
  CHECK(has(log.infos[0], "128"));
  CHECK(has(log.infos[0], ("first " + std::to_string(count)).c_str()));
  CHECK(nook_model_convert_pose(log.model, &desc, surplus.data(), count) == NOOK_OK);
  CHECK(surplus == exact);
  desc.transform_count = count - 1;
  CHECK(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(has(nook_last_message(), "desc.transform_count"));
  const std::string vertices = std::to_string(log.stage.info.file_vertex_count) + " vertices: load its own";
  CHECK(has(nook_last_message(), vertices.c_str()));
}

TEST_CASE("a clip at an uneven place is logged once for an instance and once for reading its pose") {
  const std::uint32_t strict = GENERATE(0u, 1u);
  LogStage log(strict);
  const std::vector<std::byte> bytes = nook::write_clip_set(sample_clips(sample_model()).set);
  nook_clips clips = nullptr;
  REQUIRE(nook_clips_load(log.context, log.model, bytes.data(), bytes.size(), &clips) == NOOK_OK);
  const nook_clip_time time{0, NOOK_CLIP_LOOP, 0.1};
  const float place[12] = {1, 0, 0, 0, 0, 1.3f, 0, 0, 0, 0, 1, 0};
  for (int frame = 0; frame < 2; ++frame)
    CHECK(nook_scene_set_clip(log.scene, log.ids[0], clips, &time, place) ==
          (strict ? NOOK_ERROR_INVALID_ARGUMENT : NOOK_OK));
  REQUIRE(log.warnings.size() == (strict ? 0u : 1u));
  if (!strict) CHECK(has(log.warnings[0], "1 1.3 1"));
  CHECK(log.uneven_instances() == (strict ? 0u : 1u));
  CHECK(nook_scene_set_clip(log.scene, log.ids[0], clips, &time, nullptr) == NOOK_OK);
  CHECK(log.uneven_instances() == 0);
  const std::uint32_t count = log.stage.info.bone_count;
  std::vector<float> bones(12 * std::size_t(count));
  log.warnings.clear();
  for (int i = 0; i < 2; ++i)
    CHECK(nook_clips_read_pose(clips, &time, place, bones.data(), count) == NOOK_OK);
  CHECK(log.warnings.size() == 1);
  nook_clips_destroy(&clips);
}

TEST_CASE("a ground above much of the body is logged once for an instance, with the likely mistake") {
  struct Ground {
    float height;  // of the body's centre; its spheres are up to 0.4 m around it
    float plane[4];
    const char* advice;  // null: no message
  };
  const Ground ground =
      GENERATE(Ground{1, {0, 1, 0, 0}, nullptr},                            // jumps above the floor
               Ground{1, {0, 1, 0, 0.5f}, nullptr},                         // stands on it
               Ground{1, {0, 1, 0, 0.62f}, nullptr},                        // sinks in a little
               Ground{1, {0, 1, 0, 1.15f}, "check its normal and height"},  // to the hip
               Ground{0.5f, {0, -1, 0, 0}, "turn the normal"}, Ground{2.5f, {0, -1, 0, 2}, "turn the normal"},
               Ground{2.5f, {0, -1, 0, -2}, "change the signs of normal and offset"},
               Ground{-1.5f, {0, 1, 0, 2}, "change the sign of the offset"},
               Ground{1, {0, 1, 0, 100}, "check its normal and height"},
               // High above the given plane, and on the plane without a likely mistake.
               Ground{2, {0, 1, 0, -1.6f}, "change the sign of the offset"},
               Ground{10, {0, 1, 0, 0.096f}, "in the unit of the poses"},
               Ground{1, {0, 1, 0, 60}, "in the unit of the poses"});
  INFO("height " << ground.height << ", normal " << ground.plane[1] << ", offset " << ground.plane[3]);
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  Rows raised = identity;
  raised[7] = ground.height;
  const std::vector<Rows> rows(count, raised);
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  for (int frame = 0; frame < 3; ++frame) {
    // Until its pose is set, a body is at the origin. Only an update tells which pose and ground belong
    // together.
    for (const nook_instance_id id : log.ids) {
      REQUIRE(nook_scene_set_ground(log.scene, id, ground.plane) == NOOK_OK);
      REQUIRE(nook_scene_set_pose(log.scene, id, &desc) == NOOK_OK);
    }
    REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  }
  REQUIRE(log.warnings.size() == (ground.advice ? 2u : 0u));
  for (std::size_t i = 0; i < log.warnings.size(); ++i) {
    INFO(log.warnings[i]);
    CHECK(has(log.warnings[i], ("instance " + std::to_string(log.ids[i])).c_str()));
    CHECK(has(log.warnings[i], ground.advice));
  }
}

TEST_CASE("a body that never comes near its ground is mentioned after ten seconds of updates") {
  const float height = GENERATE(0.6f, 4.0f);  // the body is about 0.7 m tall
  const bool lands = GENERATE(false, true);
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  Rows raised = identity, landed = identity;
  raised[7] = height;
  landed[7] = 0.5f;
  const std::vector<Rows> high(count, raised), low(count, landed);
  const nook_pose_desc flies = pose_of_rows(high[0].data(), count),
                       stands = pose_of_rows(low[0].data(), count);
  const float plane[4] = {0, 1, 0, 0};
  for (const nook_instance_id id : log.ids) REQUIRE(nook_scene_set_ground(log.scene, id, plane) == NOOK_OK);
  for (int frame = 0; frame < 620; ++frame) {
    for (const nook_instance_id id : log.ids)
      REQUIRE(nook_scene_set_pose(log.scene, id, lands && frame == 100 ? &stands : &flies) == NOOK_OK);
    REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  }
  CHECK(log.warnings.empty());
  REQUIRE(log.infos.size() == (height > 2 && !lands ? 2u : 0u));
  for (const std::string& line : log.infos)
    CHECK(has(line, "never nearer to its ground than its own height"));
}

TEST_CASE("a distance of links that is too short for every body is logged once") {
  struct Links {
    float distance;  // the sample's radius is 0.9 m
    bool is_logged;
  };
  const Links links = GENERATE(Links{3, false}, Links{0.5f, false}, Links{0.03f, true});
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const std::vector<Rows> rows(count, identity);
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  Rows moved = identity;
  moved[3] = 1;
  const std::vector<Rows> beside(count, moved);
  const nook_pose_desc other = pose_of_rows(beside[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[1], &other) == NOOK_OK);
  REQUIRE(nook_scene_link_nearest(log.scene, 4, links.distance) == NOOK_OK);
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  REQUIRE(log.warnings.size() == (links.is_logged ? 1u : 0u));
  if (links.is_logged) CHECK(has(log.warnings[0], "nook_scene_link_nearest: max_distance is so short"));
  // A small body may stand close to another one.
  if (!links.is_logged) return;
  log.warnings.clear();
  Rows small = identity;
  for (const std::size_t i : {0, 5, 10}) small[i] = 0.02f;
  small[3] = 0.02f;
  const std::vector<Rows> mouse(count, small);
  const nook_pose_desc third = pose_of_rows(mouse[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[1], &third) == NOOK_OK);
  REQUIRE(nook_scene_link_nearest(log.scene, 4, links.distance) == NOOK_OK);
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  CHECK(log.warnings.empty());
}

TEST_CASE("an occluder that contains a whole body is logged once for the instance") {
  const float unit = GENERATE(1.0f, 100.0f);
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const std::vector<Rows> rows(count, identity);
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  // A ball at the knee.
  const nook_occluder ball{{0.02f * unit, -0.05f * unit, 0.06f * unit}, 0.1f * unit, log.ids[0]};
  nook_occluder_id id = 0;
  REQUIRE(nook_scene_add_occluder(log.scene, &ball, &id) == NOOK_OK);
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  REQUIRE(log.warnings.size() == (unit > 1 ? 1u : 0u));
  if (unit > 1) CHECK(has(log.warnings[0], "contains the whole body"));
}

TEST_CASE("in a crowd, some later update logs a ground above the body") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  std::vector<nook_instance_id> crowd(50);
  for (nook_instance_id& id : crowd) REQUIRE(nook_scene_add_instance(log.scene, log.model, &id) == NOOK_OK);
  const std::vector<Rows> rows(count, identity);
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  const float plane[4] = {0, 1, 0, 3};
  for (const nook_instance_id id : {crowd[5], crowd[49]}) {
    REQUIRE(nook_scene_set_pose(log.scene, id, &desc) == NOOK_OK);
    REQUIRE(nook_scene_set_ground(log.scene, id, plane) == NOOK_OK);
  }
  // 52 instances, 16 for each update.
  for (int frame = 0; frame < 4; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  CHECK(log.warnings.size() == 2);
}

TEST_CASE("bones that lie far apart are logged once for an instance") {
  // Between two bones, in metres; in the rest pose the sample's radius is 0.9.
  const float apart = GENERATE(0.0f, 0.3f, 30.0f);
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  std::vector<Rows> rows(count, identity);
  for (std::size_t b = 0; b < rows.size(); ++b) rows[b][3] = apart * float(b);
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  REQUIRE(log.warnings.size() == (apart > 1 ? 1u : 0u));
  if (apart > 1) CHECK(has(log.warnings[0], "the bones lie far apart"));
  if (apart > 1) CHECK(has(log.warnings[0], ("instance " + std::to_string(log.ids[0])).c_str()));
}

TEST_CASE("a body in the place of another one is logged if it is darkened") {
  const bool is_linked = GENERATE(false, true);
  const float apart = GENERATE(0.0f, 0.5f);
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  Rows moved = identity;
  moved[3] = apart;
  const std::vector<Rows> rows(count, moved), unmoved(count, identity);
  nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[0], &desc) == NOOK_OK);
  desc = pose_of_rows(unmoved[0].data(), count);
  REQUIRE(nook_scene_set_pose(log.scene, log.ids[1], &desc) == NOOK_OK);
  if (is_linked) REQUIRE(nook_scene_link_nearest(log.scene, 4, 10) == NOOK_OK);
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  REQUIRE(log.warnings.size() == (is_linked && apart == 0 ? 2u : 0u));
  for (const std::string& line : log.warnings) CHECK(has(line, "is at the same place and darkens it"));
}

TEST_CASE("bodies without a pose are logged after a second of updates, not while the host loads") {
  LogStage log;
  const float plane[4] = {0, 1, 0, 3};
  REQUIRE(nook_scene_link_nearest(log.scene, 4, 10) == NOOK_OK);
  for (const nook_instance_id id : log.ids) REQUIRE(nook_scene_set_ground(log.scene, id, plane) == NOOK_OK);
  for (int frame = 0; frame < 59; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  CHECK(log.warnings.empty());
  REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  CHECK(log.warnings.size() == 4);  // the ground and the place of each
}

TEST_CASE("a body that the host hides with zero matrices is not called below its ground") {
  LogStage log;
  const std::uint32_t count = log.stage.info.bone_count;
  const std::vector<Rows> rows(count, Rows{});
  const nook_pose_desc desc = pose_of_rows(rows[0].data(), count);
  const float plane[4] = {0, 1, 0, 3};
  for (const nook_instance_id id : log.ids) {
    REQUIRE(nook_scene_set_ground(log.scene, id, plane) == NOOK_OK);
    REQUIRE(nook_scene_set_pose(log.scene, id, &desc) == NOOK_OK);
  }
  log.warnings.clear();  // of the zeros
  for (int frame = 0; frame < 3; ++frame) REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  for (const std::string& line : log.warnings) FAIL_CHECK(line);
}

TEST_CASE("AO that is read before the first update is logged once for an instance") {
  LogStage log;
  std::vector<float> ao(log.stage.info.file_vertex_count);
  const auto read = [&](nook_instance_id id) {
    REQUIRE(nook_scene_read(log.scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                            log.stage.info.file_vertex_count, 0) == NOOK_OK);
  };
  for (int i = 0; i < 2; ++i) read(log.ids[0]);
  REQUIRE(log.warnings.size() == 1);
  CHECK(has(log.warnings[0], "nook_scene_update was not called"));
  CHECK(has(log.warnings[0], ("instance " + std::to_string(log.ids[0])).c_str()));
  REQUIRE(nook_scene_update(log.scene) == NOOK_OK);
  for (const nook_instance_id id : log.ids) read(id);
  CHECK(log.warnings.size() == 1);
}
