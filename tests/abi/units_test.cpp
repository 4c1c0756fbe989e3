// The same scene in several units of length has the same AO, with defaults everywhere.
#include <nook/nook_character.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/abi/host.h"
#include "tests/catch.h"

using namespace nook::test;

namespace {

// The world's unit and what the context is told of it: a host may forget to tell.
struct Unit {
  float per_metre = 1, told = 1;
};

enum Feature : unsigned {
  ground = 1,
  linked = 2,
  nearest = 4,
  occluders = 8,
  levels = 16,
  lit = 32,
  paper = 64
};

std::vector<char> mannequin() {
  std::ifstream in(NOOK_MANNEQUIN, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

// A pose in metres: each bone turned about its own joint, the body at a place of its own.
std::vector<float> posed_bones(nook_model model, std::uint32_t bone_count) {
  std::vector<float> identities(12 * std::size_t(bone_count)), bind(identities.size());
  for (std::size_t i = 0; i < identities.size(); i += 12)
    identities[i] = identities[i + 5] = identities[i + 10] = 1;
  nook_pose_desc desc = pose_of_rows(identities.data(), bone_count);
  desc.kind = NOOK_POSE_JOINT_TO_WORLD;
  REQUIRE(nook_model_convert_pose(model, &desc, bind.data(), bone_count) == NOOK_OK);
  Numbers numbers(3);
  std::vector<float> out;
  for (std::uint32_t b = 0; b < bone_count; ++b) {
    // The joint's origin is where its bind matrix leads to zero; the matrix is a rotation with one scale.
    const float* const m = bind.data() + 12 * std::size_t(b);
    const float scale = m[0] * m[0] + m[4] * m[4] + m[8] * m[8];
    float joint[3];
    for (int i = 0; i < 3; ++i) joint[i] = -(m[i] * m[3] + m[4 + i] * m[7] + m[8 + i] * m[11]) / scale;
    const float angle = numbers.between(-0.3f, 0.3f), c = std::cos(angle), s = std::sin(angle);
    const float rows[12] = {c, -s, 0, joint[0] - c * joint[0] + s * joint[1],
                            s, c,  0, joint[1] - s * joint[0] - c * joint[1],
                            0, 0,  1, 0};
    out.insert(out.end(), std::begin(rows), std::end(rows));
  }
  return out;
}

class Stand {
 public:
  Stand(Unit unit, unsigned features, float ground_radius = 0) : unit_(unit), features_(features) {
    nook_context_desc context_desc;
    REQUIRE(nook_context_desc_init(&context_desc) == NOOK_OK);
    context_desc.units_per_metre = unit.told;
    REQUIRE(nook_context_create(&context_desc, &context_) == NOOK_OK);
    const std::vector<char> bytes = mannequin();
    REQUIRE(nook_model_load(context_, bytes.data(), bytes.size(), &model_) == NOOK_OK);
    nook_scene_desc scene_desc = Host::scene_desc();
    if (features & levels) scene_desc.lod_error = 0.04f;
    scene_desc.ground_radius = ground_radius;
    if (features & paper) scene_desc.form = NOOK_FORM_PAPER;
    REQUIRE(nook_scene_create(context_, &scene_desc, &scene_) == NOOK_OK);
    info_.struct_size = sizeof info_;
    REQUIRE(nook_model_describe(model_, &info_) == NOOK_OK);
    bones_ = posed_bones(model_, info_.bone_count);
    for (const float x : {0.0f, 0.7f, 6.0f}) add(x);
    put_features();
  }
  ~Stand() {
    nook_scene_destroy(&scene_);
    nook_model_destroy(&model_);
    nook_context_destroy(&context_);
  }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  std::vector<float> ao() const {
    REQUIRE(nook_scene_update(scene_) == NOOK_OK);
    std::vector<float> all;
    for (const nook_instance_id id : ids_) {
      std::vector<float> one((features_ & lit ? 3 : 1) * std::size_t(info_.file_vertex_count));
      REQUIRE(nook_scene_read(scene_, id, features_ & lit ? NOOK_CHANNEL_DIRECTIONAL_AO : NOOK_CHANNEL_AO,
                              NOOK_FORMAT_FLOAT, one.data(), info_.file_vertex_count, 0) == NOOK_OK);
      all.insert(all.end(), one.begin(), one.end());
    }
    return all;
  }

 private:
  void add(float x_m) {
    const float u = unit_.per_metre;
    const float place[12] = {0, 0, u, u * x_m, 0, u, 0, u * 0.25f, -u, 0, 0, u * -0.5f};
    nook_instance_id id = 0;
    REQUIRE(nook_scene_add_instance(scene_, model_, &id) == NOOK_OK);
    nook_pose_desc desc = pose_of_rows(bones_.data(), info_.bone_count);
    desc.place_3x4 = place;
    REQUIRE(nook_scene_set_pose(scene_, id, &desc) == NOOK_OK);
    ids_.push_back(id);
  }
  void put_features() {
    const float u = unit_.per_metre;
    const float plane[4] = {0, 1, 0, u * 0.25f};
    for (const nook_instance_id id : ids_) {
      if (features_ & ground) REQUIRE(nook_scene_set_ground(scene_, id, plane) == NOOK_OK);
      for (const nook_instance_id other : ids_)
        if ((features_ & linked) && other != id) REQUIRE(nook_scene_link(scene_, id, other) == NOOK_OK);
      const nook_lobe sun{{0, 1, 0}, 6, {3, 2, 1}, 0};
      if (features_ & lit) REQUIRE(nook_scene_set_light(scene_, id, &sun, 1) == NOOK_OK);
    }
    if (features_ & nearest) REQUIRE(nook_scene_link_nearest(scene_, 2, 4 * u) == NOOK_OK);
    for (int i = 0; (features_ & occluders) && i < 2; ++i) {
      const nook_occluder ball{{u * 0.5f, u * 1.25f, u * (0.25f - 0.75f * float(i))}, u * 0.25f, 0};
      nook_occluder_id id = 0;
      REQUIRE(nook_scene_add_occluder(scene_, &ball, &id) == NOOK_OK);
    }
    const float camera[3] = {u * 2, u * 1.5f, u * 14};
    if (features_ & levels) REQUIRE(nook_scene_set_camera(scene_, camera) == NOOK_OK);
  }

  Unit unit_;
  unsigned features_;
  nook_context context_ = nullptr;
  nook_model model_ = nullptr;
  nook_scene scene_ = nullptr;
  nook_model_info info_{};
  std::vector<float> bones_;
  std::vector<nook_instance_id> ids_;
};

double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(double(a[i]) - b[i], 2);
  return std::sqrt(sum / double(a.size()));
}

// A tenth of a step of a byte.
constexpr double allowed = 5e-4;

}  // namespace

TEST_CASE("AO is the same in every unit of length") {
  const unsigned features =
      GENERATE(0u, unsigned{ground}, unsigned{linked}, unsigned{nearest}, unsigned{occluders},
               unsigned{ground | linked | occluders}, unsigned{levels | nearest | ground},
               unsigned{lit | ground | linked}, unsigned{paper | ground | linked | occluders});
  INFO("features " << features);
  const std::vector<float> metres = Stand({}, features).ao();
  for (const float unit : {0.001f, 0.01f, 1 / 0.3048f, 100.0f, 1000.0f}) {
    INFO("units per metre " << unit);
    const double error = rms(Stand({unit, unit}, features).ao(), metres);
    CHECK(error <= allowed);
    // What has a place needs no telling. Levels have none, and a camera 14,000 units away chooses others.
    if (!(features & levels)) CHECK(rms(Stand({unit, 1}, features).ao(), metres) <= allowed);
  }
}

TEST_CASE("each feature of the scene in several units matters") {
  // Were one of them ignored, the comparison would hold for nothing.
  const std::vector<float> plain = Stand({}, 0).ao();
  for (const unsigned features : {ground, linked, nearest, occluders, levels}) {
    INFO("features " << features);
    CHECK(rms(Stand({}, features).ao(), plain) > 2 * allowed);
  }
}

TEST_CASE("levels of detail follow the unit that the context is told") {
  const std::vector<float> metres = Stand({}, levels).ao();
  CHECK(rms(Stand({100, 100}, levels).ao(), metres) <= allowed);
  CHECK(rms(Stand({100, 1}, levels).ao(), metres) > 2 * allowed);
}

TEST_CASE("the default ground is within 1e-4 of one of 10 km in a scene in metres") {
  // The sphere of 10,000 m that earlier versions had for every body; this one is 1.8 m tall.
  CHECK(rms(Stand({}, ground).ao(), Stand({}, ground, 10'000).ao()) < 1e-4);
}
