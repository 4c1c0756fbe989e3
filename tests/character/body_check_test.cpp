// The log calls a ground wrong if it darkens much of a body. It accepts the ground under a body that stands,
// jumps, lies, swims or climbs. The pose may be on the CPU, in a clip or on the GPU.
#include "sdk/src/character/body_check.h"

#include "sdk/src/character/gpu_pose.h"
#include "sdk/src/character/scene_clips.h"
#include "tests/catch.h"
#include "tests/character/clip_sample.h"
#include "tests/character/scene_sample.h"

using namespace nook;
using namespace nook::test;

namespace {

// 1.75 m high, with its feet at the origin: two legs, two arms, a trunk and a head.
CharacterModel standing_body() {
  CharacterModel model = sample_model(31);
  model.spheres.clear();
  const auto row = [&](float x, float from, float to, float radius) {
    for (float y = from; y <= to; y += 0.05f) {
      const float z = model.spheres.size() % 2 == 0 ? 0.08f : -0.08f;  // front and back
      model.spheres.push_back({{x, y, z}, radius, 0, 1});
    }
  };
  for (const float side : {-1.0f, 1.0f}) {
    row(0.1f * side, 0.05f, 0.85f, 0.06f);
    row(0.3f * side, 0.8f, 1.4f, 0.04f);
  }
  row(0, 0.9f, 1.5f, 0.15f);
  row(0, 1.6f, 1.7f, 0.1f);
  for (std::size_t k = 0; k < model.key_points.size(); ++k) {
    KeyPoint& point = model.key_points[k];
    point.position = point.surface_position =
        model.spheres[k * model.spheres.size() / model.key_points.size()].centre;
  }
  model.bounding_centre = {0, 0.875f, 0};
  model.bounding_radius = 0.93f;
  return model;
}

enum class PoseIs { in_bones, in_clip, on_gpu };

// A body whose pose is one matrix, on the CPU, in a clip that was not decoded yet, or on the GPU.
struct Posed {
  explicit Posed(PoseIs where, const Mat3x4& place) {
    const auto model = load(standing_body());
    id = add_instance(scene, model);
    set_pose(scene, id, std::vector<Mat3x4>(model->model.bone_count(), place));
    if (where == PoseIs::on_gpu) {
      const InstanceInput& input = instance().input;
      take_gpu_pose(scene, instance(), {input.bound, input.largest_scale()});
    }
    if (where != PoseIs::in_clip) return;
    ClipSample sample = sample_clips(model->model);
    for (auto& pose : sample.poses) std::fill(pose.begin(), pose.end(), Mat3x4{});
    plant_poses(sample);
    const auto clips = Owned<LoadedClips>::make(default_memory(), Ref<const RefCounted>(), sample.set, model,
                                                default_memory());
    nook_instance_clip clip{id, 0, {1, NOOK_CLIP_LOOP, 0.3}, {}};
    std::copy_n(place.m, 12, clip.place_3x4);
    set_clips(scene, clips, {&clip, 1});
  }
  Instance& instance() { return instance_of(scene, id); }
  GroundFinding on(const Plane& plane) {
    set_ground(scene, id, &plane);
    return check_ground(instance());
  }

  Scene scene = make_scene();
  nook_instance_id id = 0;
};

// Rows of a turn, then a move up.
Mat3x4 turned(std::array<Vec3, 3> rows, float up) {
  return {{rows[0].x, rows[0].y, rows[0].z, 0, rows[1].x, rows[1].y, rows[1].z, up, rows[2].x, rows[2].y,
           rows[2].z, 0}};
}

const std::array<Vec3, 3> upright{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
    on_back{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, on_side{{{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}},
    on_head{{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};

Mat3x4 scaled(Mat3x4 matrix, float scale) {
  for (float& element : matrix.m) element *= scale;
  return matrix;
}

}  // namespace

TEST_CASE("a body on or above its ground is not called wrong, also if it lies, swims, climbs or jumps") {
  struct Pose {
    const char* name;
    Mat3x4 place;
  };
  const auto& [name, place] =
      GENERATE(Pose{"stands", turned(upright, 0)}, Pose{"sinks in to the ankles", turned(upright, -0.12f)},
               Pose{"jumps", turned(upright, 1)}, Pose{"climbs", turned(upright, 6)},
               Pose{"lies on its back", turned(on_back, 0.15f)}, Pose{"lies in grass", turned(on_back, 0.1f)},
               Pose{"lies on its side", turned(on_side, 0.34f)}, Pose{"swims", turned(on_back, 1.2f)},
               Pose{"stands on its head", turned(on_head, 1.75f)});
  const PoseIs where = GENERATE(PoseIs::in_bones, PoseIs::in_clip, PoseIs::on_gpu);
  const float unit = GENERATE(1.0f, 0.01f, 100.0f);
  INFO(name << ", " << int(where) << ", unit " << unit);
  Posed body(where, scaled(place, unit));
  CHECK_FALSE(body.on({}).is_wrong);
}

TEST_CASE("a ground above much of a standing body is called wrong, with the likely mistake") {
  const PoseIs where = GENERATE(PoseIs::in_bones, PoseIs::in_clip, PoseIs::on_gpu);
  const float unit = GENERATE(1.0f, 0.01f, 100.0f), height = 2;
  INFO(int(where) << ", unit " << unit);
  Posed body(where, scaled(turned(upright, height), unit));
  CHECK_FALSE(body.on({{0, 1, 0}, height * unit}).is_wrong);
  struct Planted {
    Plane plane;
    GroundMistake mistake;
    bool needs_bones;  // the bound of a body that lies there is the same
  };
  for (const auto& [plane, mistake, needs_bones] :
       {Planted{{{0, 1, 0}, height + 0.9f}, GroundMistake::height, true},
        Planted{{{0, 0, 1}, 0.03f}, GroundMistake::height, true},
        Planted{{{0, 1, 0}, height + 1.5f}, GroundMistake::height, false},
        Planted{{{0, -1, 0}, height}, GroundMistake::turned_normal, false},
        Planted{{{0, -1, 0}, -height}, GroundMistake::both_signs, false}}) {
    INFO(plane.normal.y << " " << plane.offset);
    const GroundFinding finding = body.on({plane.normal, plane.offset * unit});
    CHECK(finding.is_wrong == (where != PoseIs::on_gpu || !needs_bones));
    if (finding.is_wrong) CHECK(finding.mistake == mistake);
  }
}

TEST_CASE("a metre too high is wrong for large bodies too, but only their feet sink in") {
  const float size = GENERATE(2.0f, 3.0f, 5.0f);
  CharacterModel model = standing_body();
  for (ProxySphere& sphere : model.spheres) {
    sphere.centre = size * sphere.centre;
    sphere.radius *= size;
  }
  for (KeyPoint& point : model.key_points) point.position = point.surface_position = size * point.position;
  model.bounding_centre = size * model.bounding_centre;
  model.bounding_radius *= size;
  Scene scene = make_scene();
  const auto loaded = load(model);
  const nook_instance_id id = add_instance(scene, loaded);
  set_pose(scene, id, std::vector<Mat3x4>(loaded->model.bone_count(), Mat3x4{}));
  const auto on = [&](float offset) {
    const Plane plane{{0, 1, 0}, offset};
    set_ground(scene, id, &plane);
    return check_ground(instance_of(scene, id));
  };
  INFO(size << " times as large as a person");
  CHECK_FALSE(on(0).is_wrong);
  CHECK_FALSE(on(0.35f).is_wrong);  // deep snow, or a step of stairs
  const GroundFinding finding = on(1);
  CHECK(finding.is_wrong);
  // The plane with the offset -1 is a metre below the feet, which is little for a large body.
  CHECK(finding.mistake == GroundMistake::height);
}

TEST_CASE("how deep a clip is below its ground is told by its bones, which stay as they are") {
  Posed body(PoseIs::in_clip, turned(upright, -3));
  const GroundFinding finding = body.on({});
  CHECK(finding.is_wrong);
  CHECK(std::abs(finding.share_below - 1) < 1e-5f);  // a sum over the spheres
  // The feet's spheres are 5 cm above the feet. The tables of clips have 16 bits.
  CHECK(std::abs(finding.depth - 2.95f) < 1e-3f);
  CHECK(body.instance().input.clip.is_late);
}

TEST_CASE("far instances of a pool that wait at one place darken nobody there") {
  Scene scene = make_scene();
  const auto model = load(standing_body());
  const nook_instance_id one = place(scene, model, {0, 0, 0}), other = place(scene, model, {0, 0, 0});
  link(scene, one, other);
  resolve_casters(scene, [](std::uint32_t) { return false; });
  CHECK(caster_at_same_place(scene, instance_of(scene, one)) == &instance_of(scene, other));
  CHECK(caster_at_same_place(scene, instance_of(scene, other)) == nullptr);
  // They leave their places of the pool together, and keep their lists of casters.
  for (const nook_instance_id id : {one, other}) instance_of(scene, id).plan.is_far = true;
  resolve_casters(scene, [](std::uint32_t) { return false; });
  CHECK(caster_at_same_place(scene, instance_of(scene, one)) == nullptr);
}
