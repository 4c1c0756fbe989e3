// Transforms in every layout and kind, against matrices that are composed by hand.
#include "sdk/src/character/pose_source.h"

#include <cmath>
#include <cstring>
#include <vector>

#include "sdk/src/character/host_vertices.h"
#include "sdk/src/character/model.h"
#include "sdk/src/character/model_file.h"
#include "sdk/src/character/pose_check.h"
#include "sdk/src/character/vertex_match.h"
#include "sdk/src/core/failure.h"
#include "tests/catch.h"
#include "tests/character/model_sample.h"

using namespace nook;
using nook::test::Numbers;

namespace {

float largest_difference(const Mat3x4& a, const Affine& b) {
  float largest = 0;
  for (int i = 0; i < 12; ++i) largest = std::max(largest, std::abs(a.m[i] - static_cast<float>(b.m[i])));
  return largest;
}

Trs random_trs(Numbers& numbers, double scale) {
  Trs trs;
  double norm = 0;
  for (int i = 0; i < 3; ++i) trs.translation[i] = numbers.between(-2, 2);
  for (double& q : trs.rotation) {
    q = numbers.between(-1, 1);
    norm += q * q;
  }
  for (double& q : trs.rotation) q /= std::sqrt(norm);
  trs.scale = {scale, scale, scale};
  return trs;
}

// The floats of one transform in a layout.
std::vector<float> in_layout(const Trs& trs, nook_transform_layout layout) {
  const Affine m = to_affine(trs);
  std::vector<double> v;
  const auto& [x, y, z, w] = trs.rotation;
  const auto& t = trs.translation;
  switch (layout) {
    case NOOK_TRANSFORM_ROWS_3X4:
      v.assign(m.m.begin(), m.m.end());
      break;
    case NOOK_TRANSFORM_ROWS_4X4:
      v.assign(m.m.begin(), m.m.end());
      v.insert(v.end(), {0, 0, 0, 1});
      break;
    case NOOK_TRANSFORM_COLUMNS_4X4:
    case NOOK_TRANSFORM_COLUMNS_4X3:
      for (std::size_t column = 0; column < 4; ++column) {
        for (std::size_t row = 0; row < 3; ++row) v.push_back(m.m[4 * row + column]);
        if (layout == NOOK_TRANSFORM_COLUMNS_4X4) v.push_back(column == 3);
      }
      break;
    case NOOK_TRANSFORM_DUAL_QUATERNION:
      // The dual part is half the translation, as a quaternion, times the real part.
      v = {x,
           y,
           z,
           w,
           0.5 * (t[0] * w + t[1] * z - t[2] * y),
           0.5 * (t[1] * w + t[2] * x - t[0] * z),
           0.5 * (t[2] * w + t[0] * y - t[1] * x),
           -0.5 * (t[0] * x + t[1] * y + t[2] * z)};
      break;
    default:
      v = {t[0], t[1], t[2], x, y, z, w, trs.scale[0], trs.scale[1], trs.scale[2]};
  }
  return {v.begin(), v.end()};
}

std::string refusal(const CharacterModel& model, PoseSource source) {
  try {
    check_pose_source(model, source);
    std::vector<Mat3x4> bones(model.bone_count());
    convert_pose(model, source, bones);
  } catch (const Failure& failure) {
    return failure.what();
  }
  return "no failure";
}

}  // namespace

TEST_CASE("transforms of every layout and stride become the same matrices") {
  const CharacterModel model = test::sample_model();
  Numbers numbers(5);
  const nook_transform_layout layout = GENERATE(range(int{NOOK_TRANSFORM_ROWS_3X4}, NOOK_TRANSFORM_TRS + 1));
  const std::size_t padding = GENERATE(0, 3);
  // A dual quaternion has no scale.
  const double scale = layout == NOOK_TRANSFORM_DUAL_QUATERNION ? 1 : 1.3;
  std::vector<float> floats;
  std::vector<Affine> expected;
  for (std::size_t b = 0; b < model.bone_count(); ++b) {
    const Trs trs = random_trs(numbers, scale);
    expected.push_back(to_affine(trs));
    const auto one = in_layout(trs, layout);
    floats.insert(floats.end(), one.begin(), one.end());
    floats.insert(floats.end(), padding, NAN);
  }
  PoseSource source;
  source.layout = layout;
  source.transforms = floats.data();
  source.transform_count = static_cast<std::uint32_t>(model.bone_count());
  source.stride = padding ? (floats_of_layout(layout) + padding) * sizeof(float) : 0;
  check_pose_source(model, source);
  std::vector<Mat3x4> bones(model.bone_count());
  convert_pose(model, source, bones);
  // A few roundings of numbers up to 4.
  for (std::size_t b = 0; b < bones.size(); ++b) CHECK(largest_difference(bones[b], expected[b]) < 2e-6f);
}

TEST_CASE("joint matrices, skinning matrices and a place compose as the header says") {
  const CharacterModel model = test::sample_model();
  const BindData& bind = model.bind;
  Numbers numbers(9);
  const auto count = static_cast<std::uint32_t>(model.bone_count());
  // The truth: one matrix a bone from rest space, in a world of centimetres that is mirrored.
  std::vector<Affine> truth;
  Affine place;
  place.m = {-100, 0, 0, 40, 0, 100, 0, 0, 0, 0, 100, -7};
  for (std::uint32_t b = 0; b < count; ++b) truth.push_back(to_affine(random_trs(numbers, 1)));
  PoseSource source;
  source.place = place;
  source.transform_count = count;
  std::vector<Mat3x4> given(count), bones(count);
  source.transforms = given[0].m;
  SECTION("joint matrices") {
    for (std::uint32_t b = 0; b < count; ++b)
      given[b] = to_float(truth[b] * inverse(to_double(bind.bones[b].node_from_rest)));
    source.kind = NOOK_POSE_JOINT_TO_WORLD;
  }
  SECTION("skinning matrices of a skin in centimetres, in the skin's order") {
    const SkinBind& skin = bind.skins[0];
    for (std::uint32_t j = 0; j < count; ++j)
      given[j] = to_float(truth[bind.bone_of_joint[skin.first_joint + j]] *
                          to_double(bind.rest_from_mesh[skin.space]));
    source.kind = NOOK_POSE_SKINNING;
    source.file_skin = skin.file_index;
  }
  SECTION("rest-to-world matrices in another order") {
    static const std::vector<std::int32_t> map{3, 1, 4, 0, 2};
    for (std::uint32_t b = 0; b < count; ++b) given[static_cast<std::size_t>(map[b])] = to_float(truth[b]);
    source.transform_of_bone = map;
  }
  check_pose_source(model, source);
  convert_pose(model, source, bones);
  // Steps of floats near 300.
  for (std::uint32_t b = 0; b < count; ++b) CHECK(largest_difference(bones[b], place * truth[b]) < 2e-4f);
}

TEST_CASE("what a pose cannot be made of is refused by name") {
  CharacterModel model = test::sample_model();
  const auto count = static_cast<std::uint32_t>(model.bone_count());
  std::vector<Mat3x4> given(count);
  PoseSource good;
  good.transforms = given[0].m;
  good.transform_count = count;
  CHECK(refusal(model, good) == "no failure");
  const auto names = [&](auto&& spoil, const char* part) {
    PoseSource source = good;
    spoil(source);
    const std::string text = refusal(model, source);
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
  };
  names([](PoseSource& s) { s.kind = 3; }, "desc.kind");
  names([](PoseSource& s) { s.layout = -1; }, "desc.layout");
  names([](PoseSource& s) { s.transforms = nullptr; }, "desc.transforms");
  names([](PoseSource& s) { s.stride = 44; }, "desc.stride");
  names([](PoseSource& s) { s.stride = 50; }, "desc.stride");
  names([](PoseSource& s) { --s.transform_count; }, "desc.transform_count");
  std::vector<std::int32_t> map{0, 1, 2, 3, 5};
  names([&](PoseSource& s) { s.transform_of_bone = map; }, "transform_of_bone[4]");
  map[4] = -1;
  names([&](PoseSource& s) { s.transform_of_bone = map; }, "bone_4");
  names(
      [&](PoseSource& s) {
        s.transform_of_bone = map;
        s.is_partial = true;
      },
      "no failure");
  names(
      [](PoseSource& s) {
        s.kind = NOOK_POSE_SKINNING;
        s.file_skin = 3;
        s.transform_count = 1;
      },
      "has no transform");
  given[2].m[6] = NAN;
  names([](PoseSource&) {}, "bone_2");
  given[2].m[6] = 0.3f;
  names([](PoseSource& s) { s.is_strict = true; }, "bone_2");
  names([](PoseSource&) {}, "no failure");
  model.bind = BindData();
  names([](PoseSource& s) { s.kind = NOOK_POSE_JOINT_TO_WORLD; }, "no bind data");
  names([](PoseSource& s) { s.kind = NOOK_POSE_SKINNING; }, "no bind data");
}

TEST_CASE("the projection is the nearest similarity") {
  // Scale factors a, b, c along the axes have the mean scale; the joint stays.
  Affine matrix;
  matrix.m = {1.2, 0, 0, 1, 0, 0.9, 0, 2, 0, 0, 0.6, 3};
  const Affine near = projected(matrix, {0.5, -0.2, 0.1});
  for (int i = 0; i < 3; ++i) CHECK(std::abs(near.m[5 * i] - 0.9) < 1e-9);
  const auto before = transform(matrix, 0.5, -0.2, 0.1), after = transform(near, 0.5, -0.2, 0.1);
  for (int i = 0; i < 3; ++i) CHECK(std::abs(before[i] - after[i]) < 1e-12);
  // No similarity near it is nearer.
  Numbers numbers(4);
  const auto distance = [&](const Affine& a) {
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) sum += std::pow(a.m[4 * i + j] - matrix.m[4 * i + j], 2);
    return sum;
  };
  Trs shear = random_trs(numbers, 1);
  shear.scale = {1.5, 0.8, 1};
  matrix = to_affine(random_trs(numbers, 1)) * to_affine(shear);
  const Affine best = projected(matrix, {0, 0, 0});
  for (int i = 0; i < 200; ++i) {
    Trs turn = random_trs(numbers, numbers.between(0.97f, 1.03f));
    // A small turn.
    for (int k = 0; k < 3; ++k) turn.rotation[k] *= 0.02;
    turn.rotation[3] = std::sqrt(1 - turn.rotation[0] * turn.rotation[0] -
                                 turn.rotation[1] * turn.rotation[1] - turn.rotation[2] * turn.rotation[2]);
    CHECK(distance(to_affine(turn) * best) >= distance(best) - 1e-12);
  }
  // A mirrored world keeps its handedness.
  for (int row = 0; row < 3; ++row) matrix.m[4 * row] = -matrix.m[4 * row];
  CHECK(determinant(projected(matrix, {0, 0, 0})) < 0);
}

TEST_CASE("bones are found by name, by prefixes and suffixes, and loosely") {
  CharacterModel model = test::sample_model();  // skeleton:bone_0 ... skeleton:bone_4
  model.bind.bones[4].first_of_joint = 1;
  std::vector<std::int32_t> map(model.bone_count());
  const auto unmatched = [&](std::vector<const char*> host, nook_bone_map_desc rules = {}) {
    rules.names = host.data();
    rules.name_count = static_cast<std::uint32_t>(host.size());
    return map_bones(model, rules, map, nook::default_memory());
  };
  using Map = std::vector<std::int32_t>;
  CHECK(unmatched({"skeleton:bone_3", nullptr, "skeleton:bone_0", "skeleton:bone_1", "skeleton:bone_2"}) ==
        0);
  // Bone 4 is of the joint of bone 1.
  CHECK(map == Map{2, 3, 4, 0, 3});
  CHECK(unmatched({"Bone 3", "BONE.0", "bone_1"}) == 5);
  nook_bone_map_desc rules{};
  rules.model_prefix = "skeleton:";
  rules.host_suffix = "_jnt";
  CHECK(unmatched({"bone_2_jnt", "bone_1"}, rules) == 2);
  CHECK(map == Map{-1, 1, 0, -1, 1});
  rules = {};
  rules.flags = NOOK_BONE_MAP_LOOSE | NOOK_BONE_MAP_DROP_SHARED_PREFIX;
  CHECK(unmatched({"rig|Bone_3", "rig|BONE.0", "rig|bone 1"}, rules) == 5);  // bone_ is shared by the model's
  rules.host_prefix = "rig|bone";
  CHECK(unmatched({"rig|bone3", "rig|bone0", "rig|bone1", "rig|bone4"}, rules) == 1);
  CHECK(map == Map{1, 2, -1, 0, 3});
}

TEST_CASE("vertices are matched by place and normal, and a remapped model is in the host's order") {
  const CharacterModel model = quantise(test::sample_model(3, {5, 7, 12, 200, 0, 4}));
  REQUIRE(model.file_to_welded.size() == 200);
  std::vector<Vec3> position(model.rest.position.begin(), model.rest.position.end());
  std::vector<Vec3> normal(model.rest.normal.begin(), model.rest.normal.end());
  // Backwards, each vertex twice, and one vertex that is none of the model's.
  std::vector<Vec3> host_position, host_normal;
  for (std::size_t i = position.size(); i-- > 0;)
    for (int copy = 0; copy < 2; ++copy) {
      host_position.push_back(position[i] + Vec3{1e-5f, -1e-5f, 1e-5f});
      host_normal.push_back(normal[i]);
    }
  host_position.push_back({5, 5, 5});
  HostVertices host;
  host.count = static_cast<std::uint32_t>(host_position.size());
  host.position = {&host_position[0].x, sizeof(Vec3)};
  host.in_rest_space = true;
  std::vector<std::uint32_t> found(host.count);
  CHECK(match_vertices(model, host, found, nook::default_memory()).unmatched == 1);
  for (std::uint32_t i = 0; i < 400; ++i) CHECK(found[i] == 199 - i / 2);
  CHECK(found[400] == no_vertex);

  found.pop_back();
  const CharacterModel mapped = remapped(model, found, nook::default_memory());
  check_model(mapped, NOOK_ERROR_INTERNAL);
  CHECK(mapped.file_to_welded.size() == 400);
  for (std::uint32_t i = 0; i < 400; ++i) CHECK(mapped.file_to_welded[i] == 199 - i / 2);
  // Two spaces in the file, one after the other.
  CHECK(mapped.primitives.size() == 2);
  CHECK(mapped.bind.vertices.size() == model.bind.vertices.size());
  for (std::size_t v = 0; v < mapped.bind.vertices.size(); ++v)
    CHECK(mapped.file_to_welded[mapped.bind.vertices[v].file_vertex] ==
          model.file_to_welded[model.bind.vertices[v].file_vertex]);
}

TEST_CASE("normals decide between the two sides of a card") {
  CharacterModel model = test::sample_model(3, {5, 7, 12, 20, 0, 4});
  model.bind.close.clear();
  for (std::size_t i = 0; i < 10; ++i) {
    model.rest.position[i + 10] = model.rest.position[i];
    model.rest.normal[i + 10] = -model.rest.normal[i];
  }
  model = quantise(model);
  const std::vector<Vec3> position(model.rest.position.begin(), model.rest.position.end());
  const std::vector<Vec3> normal(model.rest.normal.begin(), model.rest.normal.end());
  HostVertices host;
  host.count = 20;
  host.position = {&position[0].x, sizeof(Vec3)};
  host.normal = {&normal[0].x, sizeof(Vec3)};
  host.in_rest_space = true;
  std::vector<std::uint32_t> found(host.count);
  CHECK(match_vertices(model, host, found, nook::default_memory()).unmatched == 0);
  for (std::uint32_t i = 0; i < 20; ++i) CHECK(found[i] == i);
}

namespace {

// Transforms that the host has in one form and describes as another.
struct WrongForm {
  nook_transform_layout layout, named_layout;
  std::size_t named_stride;
  nook_pose_fault fault;
  const char* text;
};
const WrongForm wrong_forms[] = {
    {NOOK_TRANSFORM_ROWS_3X4, NOOK_TRANSFORM_ROWS_3X4, 64, NOOK_POSE_FAULT_UNKNOWN,
     "the transforms are 48 bytes apart, not 64; set desc.stride"},
    {NOOK_TRANSFORM_ROWS_4X4, NOOK_TRANSFORM_ROWS_3X4, 48, NOOK_POSE_FAULT_UNKNOWN,
     "the transforms are 64 bytes apart, not 48; set desc.stride"},
    {NOOK_TRANSFORM_COLUMNS_4X4, NOOK_TRANSFORM_ROWS_3X4, 48, NOOK_POSE_FAULT_TRANSPOSED,
     "have the layout NOOK_TRANSFORM_COLUMNS_4X4 and are 64 bytes apart, not NOOK_TRANSFORM_ROWS_3X4 and 48"},
    {NOOK_TRANSFORM_ROWS_3X4, NOOK_TRANSFORM_COLUMNS_4X4, 64, NOOK_POSE_FAULT_TRANSPOSED,
     "have the layout NOOK_TRANSFORM_ROWS_3X4 and are 48 bytes apart, not NOOK_TRANSFORM_COLUMNS_4X4 and 64"},
    {NOOK_TRANSFORM_COLUMNS_4X3, NOOK_TRANSFORM_COLUMNS_4X4, 64, NOOK_POSE_FAULT_UNKNOWN,
     "have the layout NOOK_TRANSFORM_COLUMNS_4X3 and are 48 bytes apart"},
    {NOOK_TRANSFORM_DUAL_QUATERNION, NOOK_TRANSFORM_ROWS_3X4, 48, NOOK_POSE_FAULT_UNKNOWN,
     "have the layout NOOK_TRANSFORM_DUAL_QUATERNION and are 32 bytes apart"},
    {NOOK_TRANSFORM_TRS, NOOK_TRANSFORM_COLUMNS_4X4, 64, NOOK_POSE_FAULT_UNKNOWN,
     "have the layout NOOK_TRANSFORM_TRS and are 40 bytes apart"},
};

}  // namespace

TEST_CASE("the check of a pose names the layout and the stride that fit the host's bytes") {
  nook::test::SampleSize size;
  size.bones = 8;
  const CharacterModel model = test::sample_model(3, size);
  Numbers numbers(11);
  for (const WrongForm& form : wrong_forms) {
    INFO(form.text);
    std::vector<float> floats;
    std::vector<Affine> bones;
    for (std::size_t b = 0; b < model.bone_count(); ++b) {
      const Trs trs = random_trs(numbers, 1);
      const std::vector<float> one = in_layout(trs, form.layout);
      bones.push_back(to_affine(trs));
      floats.insert(floats.end(), one.begin(), one.end());
    }
    const std::size_t bytes_named = model.bone_count() * form.named_stride;
    // The memory ends where the descriptor says, so that the address sanitizer sees a read beyond it.
    floats.resize(bytes_named / sizeof(float));
    std::vector<SkinnedVertex> vertices;
    for (std::uint32_t v = 0; v < model.bind.vertices.size(); ++v) {
      const RestVertex& rest = model.bind.vertices[v];
      SkinnedVertex& vertex = vertices.emplace_back();
      vertex.rest_vertex = v;
      for (std::uint32_t b = 0; b < rest.bone_count; ++b) {
        const auto p = transform(bones[rest.bone[b]], rest.position.x, rest.position.y, rest.position.z);
        for (std::size_t i = 0; i < 3; ++i) vertex.position_ws[i] += rest.weight[b] * p[i];
      }
    }
    PoseSource source;
    source.layout = form.named_layout;
    source.stride = form.named_stride;
    source.transforms = floats.data();
    source.transform_count = static_cast<std::uint32_t>(model.bone_count());
    check_pose_source(model, source);
    // 0.005 is the default of nook_pose_check_desc.
    const PoseFinding finding =
        find_pose_fault(model, source, vertices, Affine{}, 0.005, nook::default_memory());
    INFO(finding.text);
    CHECK(finding.fault == form.fault);
    CHECK(std::string(finding.text).find(form.text) != std::string::npos);
    CHECK(std::string(finding.text).find("no known mistake") == std::string::npos);
  }
}
