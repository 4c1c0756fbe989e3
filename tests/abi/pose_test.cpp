// The functions of poses and vertices: good and bad arguments, refused allocations, frames without
// allocation.
#include <nook/experimental/nook_lod.h>
#include <nook/experimental/nook_poses.h>
#include <nook/nook_character.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <string>
#include <thread>

#include "sdk/src/core/floats.h"
#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook::test;

namespace {

bool last_mentions(const char* part) {
  return std::string(nook_last_message()).find(part) != std::string::npos;
}

nook_pose_desc pose_desc(const Stage& stage) {
  return pose_of_rows(stage.pose.data(), stage.info.bone_count);
}

nook_pose_check_desc check_desc(const std::vector<float>& positions) {
  nook_pose_check_desc desc;
  nook_pose_check_desc_init(&desc);
  desc.vertex_count = static_cast<std::uint32_t>(positions.size() / 3);
  desc.positions = positions.data();
  return desc;
}

nook_vertex_match_desc match_desc(const float* positions, std::uint32_t count) {
  nook_vertex_match_desc desc;
  nook_vertex_match_desc_init(&desc);
  desc.vertex_count = count;
  desc.positions = positions;
  return desc;
}

nook_model_info info_of(nook_model model) {
  nook_model_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_model_describe(model, &info) == NOOK_OK);
  return info;
}

std::vector<float> rest_positions(nook_model model) {
  std::vector<float> out;
  nook_check_vertex_info vertex{};
  vertex.struct_size = sizeof vertex;
  for (std::uint32_t v = 0; v < info_of(model).check_vertex_count; ++v) {
    REQUIRE(nook_model_describe_check_vertex(model, v, &vertex) == NOOK_OK);
    out.insert(out.end(), vertex.position, vertex.position + 3);
  }
  return out;
}

}  // namespace

TEST_CASE("the rest pose has no fault, by the bones of a map too") {
  Stage stage;
  for (std::size_t b = 0; b < stage.pose.size(); b += 12) stage.pose[b + 3] = 0;
  std::vector<const char*> names;
  for (std::uint32_t b = 0; b < stage.info.bone_count; ++b)
    names.push_back(nook_model_bone_name(stage.model, b));
  nook_bone_map_desc of_names;
  REQUIRE(nook_bone_map_desc_init(&of_names) == NOOK_OK);
  of_names.names = names.data();
  of_names.name_count = stage.info.bone_count;
  std::vector<std::int32_t> map(names.size(), -7);
  std::uint32_t unmatched = 9;
  REQUIRE(nook_model_map_bones(stage.model, &of_names, map.data(), stage.info.bone_count, &unmatched) ==
          NOOK_OK);
  CHECK(unmatched == 0);
  CHECK(map[1] == 1);
  nook_pose_desc desc = pose_desc(stage);
  desc.transform_of_bone = map.data();
  desc.bone_count = stage.info.bone_count;
  CHECK(nook_scene_set_pose(stage.scene, stage.first, &desc) == NOOK_OK);
  const std::vector<float> positions = rest_positions(stage.model);
  const nook_pose_check_desc check = check_desc(positions);
  nook_pose_check_info fault{};
  fault.struct_size = sizeof fault;
  REQUIRE(nook_model_check_pose(stage.model, &desc, &check, &fault) == NOOK_OK);
  CHECK(fault.fault == NOOK_POSE_FAULT_NONE);
  CHECK(fault.text[0] != 0);
}

TEST_CASE("a vertex of the mesh is found by its position") {
  const Stage stage;
  nook_check_vertex_info vertex{};
  vertex.struct_size = sizeof vertex;
  REQUIRE(nook_model_describe_check_vertex(stage.model, 0, &vertex) == NOOK_OK);
  const nook_vertex_match_desc match = match_desc(vertex.mesh_position, 1);
  std::uint32_t found = NOOK_NO_VERTEX;
  nook_vertex_match_info info{};
  info.struct_size = sizeof info;
  info.unmatched = 9;
  REQUIRE(nook_model_match_vertices(stage.model, &match, &found, &info) == NOOK_OK);
  CHECK(info.unmatched == 0);
  CHECK(info.ambiguous == 0);
  CHECK(info.text[0] == 0);
  CHECK(found < stage.info.file_vertex_count);
}

TEST_CASE("a model's info counts its skins and check vertices") {
  const Stage stage;
  CHECK(stage.info.skin_count >= 1);
  CHECK(stage.info.check_vertex_count >= 8);
  nook_skin_info skin{};
  skin.struct_size = sizeof skin;
  nook_check_vertex_info vertex{};
  vertex.struct_size = sizeof vertex;
  CHECK(nook_model_describe_skin(stage.model, stage.info.skin_count - 1, &skin) == NOOK_OK);
  CHECK(nook_model_describe_skin(stage.model, stage.info.skin_count, &skin) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(nook_model_describe_check_vertex(stage.model, stage.info.check_vertex_count - 1, &vertex) == NOOK_OK);
  CHECK(nook_model_describe_check_vertex(stage.model, stage.info.check_vertex_count, &vertex) ==
        NOOK_ERROR_INVALID_ARGUMENT);

  nook::CharacterModel unbound = sample_model();
  unbound.bind = nook::BindData();
  const std::vector<std::byte> bytes = nook::write_character_model(unbound);
  nook_model model = nullptr;
  REQUIRE(nook_model_load(stage.context, bytes.data(), bytes.size(), &model) == NOOK_OK);
  CHECK(info_of(model).skin_count == 0);
  CHECK(info_of(model).check_vertex_count == 0);
  CHECK(nook_model_describe_skin(model, 0, &skin) == NOOK_ERROR_UNSUPPORTED);
  nook_model_destroy(&model);
}

TEST_CASE("a pose that is refused leaves the instance as it was") {
  Stage stage;
  REQUIRE(set_rows(stage.scene, stage.first, stage.pose.data(), stage.info.bone_count) == NOOK_OK);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                          stage.info.file_vertex_count, 0) == NOOK_OK);
  const std::vector<float> before = stage.ao;
  const auto refused = [&](auto&& spoil, nook_result result, const char* part) {
    nook_pose_desc desc = pose_desc(stage);
    spoil(desc);
    CHECK(nook_scene_set_pose(stage.scene, stage.first, &desc) == result);
    INFO(nook_last_message());
    CHECK(last_mentions(part));
  };
  const auto invalid = [&](auto&& spoil, const char* part) {
    refused(spoil, NOOK_ERROR_INVALID_ARGUMENT, part);
  };
  std::vector<float> broken = stage.pose;
  broken[12 * 3 + 1] = NAN;
  const float huge[12] = {1, 0, 0, 1e30f, 0, 1, 0, 0, 0, 0, 1, 0};
  std::vector<std::int32_t> map(stage.info.bone_count, 0);
  map.back() = 1000;
  invalid([](nook_pose_desc& d) { d.kind = 7; }, "desc.kind");
  invalid([](nook_pose_desc& d) { d.layout = 6; }, "desc.layout");
  invalid([](nook_pose_desc& d) { d.flags = 8; }, "desc.flags");
  invalid([](nook_pose_desc& d) { d.transforms = nullptr; }, "desc.transforms");
  invalid([](nook_pose_desc& d) { d.stride = 8; }, "desc.stride");
  invalid([](nook_pose_desc& d) { d.transform_count = 0; }, "desc.transform_count");
  invalid([](nook_pose_desc& d) { d.bone_count = 5; }, "desc.transform_of_bone");
  invalid([&](nook_pose_desc& d) { d.transforms = broken.data(); }, "bone 3");
  invalid([&](nook_pose_desc& d) { d.place_3x4 = huge; }, "desc.place_3x4");
  invalid(
      [&](nook_pose_desc& d) {
        d.transform_of_bone = map.data();
        d.bone_count = static_cast<std::uint32_t>(map.size());
      },
      "desc.transform_of_bone");
  invalid(
      [](nook_pose_desc& d) {
        d.kind = NOOK_POSE_SKINNING;
        d.skin = 77;
      },
      "desc.skin");
  nook_pose_desc desc = pose_desc(stage);
  CHECK(nook_scene_set_pose(stage.scene, 4711, &desc) == NOOK_ERROR_INVALID_HANDLE);
  desc.struct_size = 8;
  CHECK(nook_scene_set_pose(stage.scene, stage.first, &desc) == NOOK_ERROR_INVALID_ARGUMENT);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                          stage.info.file_vertex_count, 0) == NOOK_OK);
  CHECK(stage.ao == before);
}

TEST_CASE("by default, a pose consists of skinning matrices, stored as 4x4 columns") {
  nook_pose_desc desc;
  REQUIRE(nook_pose_desc_init(&desc) == NOOK_OK);
  CHECK(desc.kind == NOOK_POSE_SKINNING);
  CHECK(desc.layout == NOOK_TRANSFORM_COLUMNS_4X4);
}

TEST_CASE("a model without bind data accepts only rest-to-world matrices, and the message says what to do") {
  const Stage stage;
  nook::CharacterModel unbound = sample_model();
  unbound.bind = nook::BindData();
  const std::vector<std::byte> bytes = nook::write_character_model(unbound);
  nook_model model = nullptr;
  nook_instance_id id = 0;
  REQUIRE(nook_model_load(stage.context, bytes.data(), bytes.size(), &model) == NOOK_OK);
  REQUIRE(nook_scene_add_instance(stage.scene, model, &id) == NOOK_OK);
  nook_model_destroy(&model);
  nook_pose_desc desc = pose_desc(stage);
  CHECK(nook_scene_set_pose(stage.scene, id, &desc) == NOOK_OK);
  for (const nook_pose_kind kind : {NOOK_POSE_SKINNING, NOOK_POSE_JOINT_TO_WORLD}) {
    desc.kind = kind;
    CHECK(nook_scene_set_pose(stage.scene, id, &desc) == NOOK_ERROR_UNSUPPORTED);
    INFO(nook_last_message());
    CHECK(last_mentions("bake it again from the glTF file"));
    CHECK(last_mentions("NOOK_POSE_REST_TO_WORLD"));
  }
}

TEST_CASE("joint matrices of the identity give the bind matrix of each bone") {
  const Stage stage;
  const nook::CharacterModel model = sample_model();
  const std::uint32_t count = stage.info.bone_count;
  std::vector<float> identities(12 * std::size_t(count)), bind(12 * std::size_t(count));
  for (std::size_t i = 0; i < identities.size(); i += 12)
    identities[i] = identities[i + 5] = identities[i + 10] = 1;
  nook_pose_desc desc = pose_of_rows(identities.data(), count);
  desc.kind = NOOK_POSE_JOINT_TO_WORLD;
  REQUIRE(nook_model_convert_pose(stage.model, &desc, bind.data(), count) == NOOK_OK);
  for (std::uint32_t b = 0; b < count; ++b)
    for (std::size_t i = 0; i < 12; ++i) CHECK(bind[12 * b + i] == model.bind.bones[b].node_from_rest.m[i]);
}

TEST_CASE("checks and matches refuse what they cannot compare") {
  Stage stage;
  std::vector<float> positions = rest_positions(stage.model);
  const nook_pose_desc desc = pose_desc(stage);
  const auto refused = [&](auto&& spoil, const char* part) {
    nook_pose_check_desc check = check_desc(positions);
    nook_pose_check_info info{};
    info.struct_size = sizeof info;
    spoil(check);
    CHECK(nook_model_check_pose(stage.model, &desc, &check, &info) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(last_mentions(part));
  };
  const std::uint32_t far_index[8] = {0, 1, 2, 3, 4, 5, 6, 900};
  refused([](nook_pose_check_desc& c) { c.struct_size = 16; }, "nook_pose_check_desc_init");
  refused([](nook_pose_check_desc& c) { c.vertex_count = 7; }, "check.vertex_count");
  refused([](nook_pose_check_desc& c) { c.positions = nullptr; }, "check.positions");
  refused([](nook_pose_check_desc& c) { c.stride = 4; }, "check.stride");
  refused([](nook_pose_check_desc& c) { c.tolerance = -1; }, "check.tolerance");
  refused(
      [&](nook_pose_check_desc& c) {
        c.vertex_count = 8;
        c.check_vertices = far_index;
      },
      "check.check_vertices[7]");
  positions[4] = INFINITY;
  refused([](nook_pose_check_desc&) {}, "position 1");

  std::uint32_t found[2];
  const float two[6] = {};
  const auto no_match = [&](auto&& spoil, const char* part) {
    nook_vertex_match_desc match = match_desc(two, 2);
    spoil(match);
    CHECK(nook_model_match_vertices(stage.model, &match, found, nullptr) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(last_mentions(part));
  };
  const float not_finite[6] = {0, 0, 0, 0, NAN, 0};
  no_match([](nook_vertex_match_desc& m) { m.struct_size = 8; }, "nook_vertex_match_desc_init");
  no_match([](nook_vertex_match_desc& m) { m.positions = nullptr; }, "desc.positions");
  no_match([](nook_vertex_match_desc& m) { m.position_stride = 8; }, "desc.position_stride");
  no_match([&](nook_vertex_match_desc& m) { m.normals = not_finite; }, "desc.normals[1]");
  no_match([](nook_vertex_match_desc& m) { m.primitive = 2; }, "desc.primitive");
  no_match([](nook_vertex_match_desc& m) { m.tolerance = 2; }, "desc.tolerance");
  no_match([](nook_vertex_match_desc& m) { m.in_rest_space = 2; }, "desc.in_rest_space");
  static const std::uint16_t joints[] = {0, 0, 0, 0, 0, 9999, 0, 0};
  static const float weights[] = {1, 0, 0, 0, 1, 0, 0, 0}, far_joint[] = {1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
  static const float not_a_number[] = {1, 0, 0, 0, 1, 0, 0, NAN}, negative[] = {1, 0, 0, 0, 1, 0, -1, 0};
  const auto no_weights = [&](const float* given, auto spoil, const char* what) {
    no_match(
        [&](nook_vertex_match_desc& m) {
          m.joints = joints;
          m.weights = given;
          m.skin = 1;
          spoil(m);
        },
        what);
  };
  no_weights(
      nullptr, [](nook_vertex_match_desc&) {}, "desc.weights is NULL, but desc.joints is not");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.joints = nullptr; }, "desc.joints is NULL");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.influences = 9; }, "desc.influences");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.influences = 0; }, "desc.influences");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.skin = 77; },
      "desc.skin is not a skin of the model (got 77");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.joint_stride = 6; }, "desc.joint_stride");
  no_weights(
      weights, [](nook_vertex_match_desc& m) { m.weight_stride = 12; }, "desc.weight_stride");
  no_weights(
      not_a_number, [](nook_vertex_match_desc&) {}, "desc.weights[3] of vertex 1");
  no_weights(
      negative, [](nook_vertex_match_desc&) {}, "desc.weights[2] of vertex 1");
  no_weights(
      far_joint, [](nook_vertex_match_desc&) {}, "desc.joints[1] of vertex 1");
  const std::uint32_t none[2] = {0, NOOK_NO_VERTEX};
  nook_model remapped = nullptr;
  CHECK(nook_model_remap(stage.model, none, 2, &remapped) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("vertices[1] is NOOK_NO_VERTEX, as are 1 of 2"));
  CHECK(last_mentions("glVertexAttrib1f"));
  CHECK(remapped == nullptr);
  const std::uint32_t far[1] = {stage.info.file_vertex_count};
  CHECK(nook_model_remap(stage.model, far, 1, &remapped) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("vertices[0] is out of range"));
}

TEST_CASE("a model of another mesh is named as such, with its number of vertices") {
  const Stage stage;
  const std::string vertices = std::to_string(stage.info.file_vertex_count);
  const float far[6] = {50, 50, 50, 51, 50, 50};
  const nook_vertex_match_desc match = match_desc(far, 2);
  std::uint32_t found[2];
  nook_vertex_match_info info{};
  info.struct_size = sizeof info;
  REQUIRE(nook_model_match_vertices(stage.model, &match, found, &info) == NOOK_OK);
  CHECK(info.unmatched == 2);
  CHECK(std::string(info.text).find("2 of 2 vertices are not near any of the model's " + vertices) == 0);
  CHECK(std::string(info.text).find("baked for another mesh") != std::string::npos);
  std::vector<float> ao(stage.info.file_vertex_count + 1);
  CHECK(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                        stage.info.file_vertex_count + 1, 0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("baked for another mesh"));
}

TEST_CASE("a remapped model gives the same AO in the host's order") {
  Stage stage;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < 3 * stage.info.file_vertex_count; ++i)
    order.push_back(i * 7919 % stage.info.file_vertex_count);
  nook_model remapped = nullptr;
  REQUIRE(nook_model_remap(stage.model, order.data(), static_cast<std::uint32_t>(order.size()), &remapped) ==
          NOOK_OK);
  nook_instance_id id = 0;
  REQUIRE(nook_scene_add_instance(stage.scene, remapped, &id) == NOOK_OK);
  nook_model_destroy(&remapped);
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                          stage.info.file_vertex_count, 0) == NOOK_OK);
  std::vector<float> ao(order.size());
  REQUIRE(nook_scene_read(stage.scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, ao.data(),
                          static_cast<std::uint32_t>(ao.size()), 0) == NOOK_OK);
  for (std::size_t i = 0; i < ao.size(); ++i) CHECK(ao[i] == stage.ao[order[i]]);
}

TEST_CASE("a mesh that cannot be resampled is refused, and the message names what is wrong") {
  Stage stage;
  const std::vector<float> positions = rest_positions(stage.model);
  nook_vertex_match_desc mesh = match_desc(positions.data(), 2);
  mesh.in_rest_space = 1;
  nook_model model = nullptr;
  const auto refused = [&](auto&& spoil, const char* part) {
    nook_vertex_match_desc spoiled = mesh;
    spoil(spoiled);
    CHECK(nook_model_resample(stage.model, &spoiled, &model) == NOOK_ERROR_INVALID_ARGUMENT);
    INFO(nook_last_message());
    CHECK(last_mentions(part));
    CHECK(model == nullptr);
  };
  const float far_away[6] = {0, 0, 0, 0, 1e4f, 0}, not_finite[6] = {0, 0, 0, 0, NAN, 0};
  refused([](nook_vertex_match_desc& m) { m.vertex_count = 0; }, "desc.vertex_count");
  refused([](nook_vertex_match_desc& m) { m.positions = nullptr; }, "desc.positions");
  refused([&](nook_vertex_match_desc& m) { m.positions = not_finite; }, "desc.positions[1]");
  refused([&](nook_vertex_match_desc& m) { m.positions = far_away; }, "vertex 1 of the mesh is too far");
  refused([](nook_vertex_match_desc& m) { m.primitive = 99; }, "desc.primitive");
}

TEST_CASE("setting a pose allocates nothing in any form") {
  Stage stage;
  nook_pose_desc desc = pose_desc(stage);
  std::vector<float> columns(16 * std::size_t(stage.info.bone_count));
  for (std::size_t i = 0; i < columns.size(); i += 16)
    columns[i] = columns[i + 5] = columns[i + 10] = columns[i + 15] = 1;
  SECTION("as Nook's own matrices") {}
  SECTION("as joint matrices") {
    desc.kind = NOOK_POSE_JOINT_TO_WORLD;
    desc.layout = NOOK_TRANSFORM_COLUMNS_4X4;
    desc.transforms = columns.data();
  }
  const int before = stage.host.allocations;
  for (int frame = 0; frame < 3; ++frame)
    REQUIRE(nook_scene_set_pose(stage.scene, stage.second, &desc) == NOOK_OK);
  CHECK(stage.host.allocations == before);
}

TEST_CASE("each allocation of the functions of poses refused in turn is one clean failure") {
  Stage stage;
  const std::vector<float> positions = rest_positions(stage.model);
  const nook_pose_desc desc = pose_desc(stage);
  const auto run = [&] {
    const nook_pose_check_desc check = check_desc(positions);
    nook_pose_check_info info{};
    info.struct_size = sizeof info;
    nook_result first = nook_model_check_pose(stage.model, &desc, &check, &info);
    std::vector<std::int32_t> map(stage.info.bone_count);
    const char* name = "skeleton:bone_1_with_a_name_that_is_longer_than_a_small_string";
    nook_bone_map_desc names;
    nook_bone_map_desc_init(&names);
    names.names = &name;
    names.name_count = 1;
    if (first == NOOK_OK)
      first = nook_model_map_bones(stage.model, &names, map.data(), stage.info.bone_count, nullptr);
    const nook_vertex_match_desc match = match_desc(positions.data(), 2);
    std::uint32_t found[2] = {0, 0};
    if (first == NOOK_OK) first = nook_model_match_vertices(stage.model, &match, found, nullptr);
    const std::uint32_t order[2] = {1, 0};
    nook_model remapped = nullptr;
    if (first == NOOK_OK) first = nook_model_remap(stage.model, order, 2, &remapped);
    nook_model_destroy(&remapped);
    if (first == NOOK_OK) first = nook_model_resample(stage.model, &match, &remapped);
    nook_model_destroy(&remapped);
    return first;
  };
  const int before = stage.host.allocations, blocks = stage.host.blocks;
  REQUIRE(run() == NOOK_OK);
  const int total = stage.host.allocations - before;
  REQUIRE(total > 20);
  for (int n = 0; n < total; ++n) {
    stage.host.refuse_at = stage.host.allocations + n;
    INFO("allocation " << n);
    CHECK(run() == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(stage.host.blocks == blocks);
  }
}

TEST_CASE("AO is read as bytes and halves, among a host's own attributes") {
  Stage stage;
  REQUIRE(nook_scene_update(stage.scene) == NOOK_OK);
  const std::uint32_t count = stage.info.file_vertex_count;
  REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, stage.ao.data(),
                          count, 0) == NOOK_OK);
  for (const nook_format format : {NOOK_FORMAT_FLOAT, NOOK_FORMAT_HALF, NOOK_FORMAT_UNORM8})
    for (const std::size_t stride : {std::size_t{0}, std::size_t{24}}) {
      const std::size_t each = sizeof(float) >> format, step = stride ? stride : each;
      std::vector<unsigned char> out(step * count, 0xa5);
      REQUIRE(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, format, out.data(), count, stride) ==
              NOOK_OK);
      for (std::uint32_t v = 0; v < count; ++v) {
        const unsigned char* const place = &out[v * step];
        float value = 0;
        std::uint16_t half = 0;
        std::memcpy(&value, place, std::min(each, sizeof value));
        std::memcpy(&half, place, std::min(each, sizeof half));
        if (format == NOOK_FORMAT_UNORM8) value = static_cast<float>(*place) / 255;
        if (format == NOOK_FORMAT_HALF) value = nook::from_half(half);
        // Half a step of a byte, and of a half below 1.
        const float tolerance = format == NOOK_FORMAT_UNORM8 ? 0.5f / 255 + 1e-6f
                                : format == NOOK_FORMAT_HALF ? 0.25f / 1024
                                                             : 0;
        CHECK(std::abs(value - stage.ao[v]) <= tolerance);
        for (std::size_t i = each; i < step; ++i) CHECK(place[i] == 0xa5);
      }
    }
  CHECK(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, 4, stage.ao.data(), count, 0) ==
        NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("format"));
  CHECK(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_SNORM8, stage.ao.data(), count,
                        0) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("NOOK_FORMAT_SNORM8"));
  CHECK(nook_scene_read(stage.scene, stage.first, NOOK_CHANNEL_AO, NOOK_FORMAT_HALF, stage.ao.data(), count,
                        1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("stride"));
}

namespace {

constexpr float ground[4] = {0, 1, 0, -1.5f};

// Poses that turn each bone about y by an angle of its own.
std::vector<float> turning_poses(std::uint32_t count, std::uint32_t bones) {
  std::vector<float> rows;
  for (std::uint32_t i = 0; i < count * bones; ++i) {
    const float c = std::cos(0.37f * float(i)), s = std::sin(0.37f * float(i));
    rows.insert(rows.end(), {c, 0, s, 0.1f, 0, 1, 0, 0, -s, 0, c, 0});
  }
  return rows;
}

// The AO of poses in a scene of its own, one after the other.
std::vector<float> read_in_scene(const Stage& stage, const nook_scene_desc& settings, nook_pose_desc pose,
                                 std::uint32_t pose_count, const float* plane) {
  nook_scene scene = nullptr;
  nook_instance_id id = 0;
  REQUIRE(nook_scene_create(stage.context, &settings, &scene) == NOOK_OK);
  REQUIRE(nook_scene_add_instance(scene, stage.model, &id) == NOOK_OK);
  REQUIRE(nook_scene_set_ground(scene, id, plane) == NOOK_OK);
  const std::uint32_t vertices = stage.info.file_vertex_count;
  std::vector<float> ao(std::size_t{pose_count} * vertices);
  for (std::uint32_t p = 0; p < pose_count; ++p, pose.transforms += 12 * stage.info.bone_count) {
    REQUIRE(nook_scene_set_pose(scene, id, &pose) == NOOK_OK);
    REQUIRE(nook_scene_update(scene) == NOOK_OK);
    REQUIRE(nook_scene_read(scene, id, NOOK_CHANNEL_AO, NOOK_FORMAT_FLOAT, &ao[p * vertices], vertices, 0) ==
            NOOK_OK);
  }
  nook_scene_destroy(&scene);
  return ao;
}

}  // namespace

TEST_CASE("many poses in one call have the bits of a scene, on any number of threads") {
  Stage stage;
  constexpr std::uint32_t poses = 41;
  const std::uint32_t bones = stage.info.bone_count;
  const std::vector<float> rows = turning_poses(poses, bones);
  const nook_pose_desc first = pose_of_rows(rows.data(), bones);
  nook_scene_desc paper = Host::scene_desc();
  paper.form = NOOK_FORM_PAPER;
  // Reversed and on two threads: no order and no thread may count.
  const auto backwards = [](void* user, std::uint32_t count, nook_job_fn body, void* body_user) {
    static_cast<std::atomic<int>*>(user)->fetch_add(int(count));
    std::thread other([=] {
      for (std::uint32_t i = count; i-- > 1;)
        if (i % 2) body(body_user, i);
    });
    for (std::uint32_t i = count; i-- > 0;)
      if (i % 2 == 0) body(body_user, i);
    other.join();
  };
  std::atomic<int> jobs{0};
  nook_context_desc desc = stage.host.context_desc();
  desc.parallel_for = backwards;
  desc.parallel_for_user = &jobs;
  nook_context threaded = nullptr;
  REQUIRE(nook_context_create(&desc, &threaded) == NOOK_OK);
  nook_model other = nullptr;
  REQUIRE(nook_model_load(threaded, stage.host.bytes.data(), stage.host.bytes.size(), &other) == NOOK_OK);
  for (const nook_scene_desc& settings : {Host::scene_desc(), paper})
    for (const float* plane : {static_cast<const float*>(nullptr), ground}) {
      const std::vector<float> expected = read_in_scene(stage, settings, first, poses, plane);
      CHECK(*std::max_element(expected.begin(), expected.end()) >
            *std::min_element(expected.begin(), expected.end()));
      for (nook_model model : {stage.model, other}) {
        std::vector<float> ao(expected.size(), -1.0f);
        REQUIRE(nook_model_evaluate_poses(model, &settings, &first, poses, 0, plane, ao.data(), ao.size()) ==
                NOOK_OK);
        CHECK(std::memcmp(ao.data(), expected.data(), ao.size() * sizeof(float)) == 0);
      }
    }
  CHECK(jobs > 2);
  // Every second pose, by a stride; and without settings.
  const std::vector<float> expected = read_in_scene(stage, Host::scene_desc(), first, poses, nullptr);
  const std::uint32_t vertices = stage.info.file_vertex_count;
  std::vector<float> ao(std::size_t{2} * vertices, -1.0f);
  REQUIRE(nook_model_evaluate_poses(stage.model, nullptr, &first, 2, std::size_t{2} * 48 * bones, nullptr,
                                    ao.data(), ao.size()) == NOOK_OK);
  CHECK(std::equal(ao.begin(), ao.begin() + vertices, expected.begin()));
  CHECK(std::equal(ao.begin() + vertices, ao.end(), expected.begin() + 2 * vertices));
  // No pose writes nothing.
  CHECK(nook_model_evaluate_poses(stage.model, nullptr, &first, 0, 0, nullptr, nullptr, 0) == NOOK_OK);
  nook_model_destroy(&other);
  nook_context_destroy(&threaded);
}

TEST_CASE("a partial pose leaves the other bones of each pose at rest") {
  Stage stage;
  const std::uint32_t bones = stage.info.bone_count;
  const std::vector<float> rows = turning_poses(2, bones);
  std::vector<std::int32_t> map(bones, -1), all(bones, 0);
  map[0] = 0;
  nook_pose_desc first = pose_of_rows(rows.data(), bones);
  first.transform_of_bone = map.data();
  first.bone_count = bones;
  first.flags = NOOK_POSE_FLAG_PARTIAL;
  std::vector<float> both(std::size_t{2} * stage.info.file_vertex_count), alone(both.size() / 2);
  REQUIRE(nook_model_evaluate_poses(stage.model, nullptr, &first, 2, 0, nullptr, both.data(), both.size()) ==
          NOOK_OK);
  first.transforms += 12 * bones;
  REQUIRE(nook_model_evaluate_poses(stage.model, nullptr, &first, 1, 0, nullptr, alone.data(),
                                    alone.size()) == NOOK_OK);
  CHECK(std::equal(alone.begin(), alone.end(), both.begin() + std::ptrdiff_t(alone.size())));
}

TEST_CASE("many poses: what is refused is named, and no memory is lost") {
  Stage stage;
  constexpr std::uint32_t poses = 5;
  const std::uint32_t bones = stage.info.bone_count;
  std::vector<float> rows = turning_poses(poses, bones);
  std::vector<float> ao(std::size_t{poses} * stage.info.file_vertex_count);
  nook_pose_desc first = pose_of_rows(rows.data(), bones);
  const auto run = [&](std::size_t stride = 0, std::size_t missing = 0, const float* plane = nullptr) {
    return nook_model_evaluate_poses(stage.model, nullptr, &first, poses, stride, plane, ao.data(),
                                     ao.size() - missing);
  };
  const int blocks = stage.host.blocks, before = stage.host.allocations;
  REQUIRE(run() == NOOK_OK);
  const int total = stage.host.allocations - before;
  REQUIRE(total > 5);
  for (int n = 0; n < total; ++n) {
    stage.host.refuse_at = stage.host.allocations + n;
    INFO("allocation " << n);
    CHECK(run() == NOOK_ERROR_OUT_OF_MEMORY);
    CHECK(stage.host.blocks == blocks);
  }
  CHECK(run(0, 1) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("nook_model_evaluate_poses: count is not pose_count times"));
  CHECK(run(std::size_t{48} * bones - 4) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("pose_stride is too small"));
  CHECK(run(std::size_t{48} * bones + 2) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("pose_stride is not a multiple of 4"));
  constexpr float slanted[4] = {1, 1, 0, 0};
  CHECK(run(0, 0, slanted) == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("the normal of the plane"));
  rows[(3 * bones + 1) * 12] = NAN;
  CHECK(run() == NOOK_ERROR_INVALID_ARGUMENT);
  CHECK(last_mentions("nook_model_evaluate_poses: pose 3: "));
  --first.transform_count;
  CHECK(run() == NOOK_ERROR_INVALID_ARGUMENT);
}
