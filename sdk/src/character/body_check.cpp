#include "sdk/src/character/body_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sdk/src/character/scene_clips.h"

namespace nook {
namespace {

struct Depth {
  float share_below = 0, share_deep = 0;
  // Signed distances of the lowest and the highest point from the plane, in metres.
  float lowest = INFINITY, highest = -INFINITY;
};

// The depth from which a part of the body counts as deep, in metres of the model, and the share of the body
// that must be that deep.
struct DeepLimit {
  float depth, share;
};
DeepLimit deep_limit(const CharacterModel& model) {
  const float radius = model.bounding_radius, of_people = 0.3f * radius,
              of_large_bodies = std::max(0.1f * radius, 0.6f);
  return of_large_bodies < of_people ? DeepLimit{of_large_bodies, 0.015f} : DeepLimit{of_people, 0.05f};
}

// Returns true if the bones of the current pose are on the CPU, or if a clip on the CPU can provide them.
bool has_bones(const Instance& instance) {
  return !instance.input.is_posed_on_gpu && (instance.input.clip.is_late || !instance.bones().empty());
}

float height_of_bound(const Sphere& bound, const Plane& plane) {
  return dot(plane.normal, bound.centre) - plane.offset;
}

// Estimates the depth from the bound. Use it for poses whose bones are only on the GPU. A body that lies on
// the ground can have the same bound as a body that stands in the ground up to its hips. So the function
// reports a share below the plane only if the bound's centre is deep. A standing body reaches down to about
// 0.85 bounding radii of its rest pose below the centre. The host may pass a larger bound.
Depth depth_of_bound(const Instance& instance, const Plane& plane) {
  const Sphere& bound = instance.input.bound;
  const float in_rest = instance.model->model.bounding_radius * instance.input.largest_scale();
  const float middle = height_of_bound(bound, plane), half = 0.85f * std::min(in_rest, bound.radius);
  if (!(middle < -0.3f * bound.radius)) return {0, 0, middle - half, middle + half};
  return {std::clamp(0.5f - 0.5f * middle / std::max(half, 1e-9f), 0.0f, 1.0f), 1, middle - half,
          middle + half};
}

Depth depth_of_spheres(const Instance& instance, const Plane& plane) {
  const CharacterModel& model = instance.model->model;
  const float deep = -deep_limit(model).depth * instance.input.largest_scale();
  const float share = 1 / float(std::max<std::size_t>(model.spheres.size(), 1));
  Depth depth;
  Mat3x4 bone;
  for (std::size_t s = 0; s < model.spheres.size(); ++s) {
    const ProxySphere& sphere = model.spheres[s];
    // Neighbouring spheres often share a bone. Reusing it saves decoding it from the clip again.
    if (s == 0 || sphere.bone != model.spheres[s - 1].bone) bone = bone_of(instance, sphere.bone);
    const float distance = dot(plane.normal, transform_point(bone, sphere.centre)) - plane.offset;
    depth.share_below += distance < 0 ? share : 0;
    depth.share_deep += distance < deep ? share : 0;
    depth.lowest = std::min(depth.lowest, distance);
    depth.highest = std::max(depth.highest, distance);
  }
  return depth;
}

Depth depth_below(const Instance& instance, const Plane& plane) {
  return has_bones(instance) ? depth_of_spheres(instance, plane) : depth_of_bound(instance, plane);
}

// Avoids decoding the bones of a clip, which takes time. The centre of a standing body's bound is about 0.8
// of its radius above the ground.
bool is_surely_above(const Instance& instance, const Plane& plane) {
  const Sphere& bound = instance.input.bound;
  return instance.input.clip.is_late && height_of_bound(bound, plane) > 0.2f * bound.radius;
}

struct OtherGround {
  GroundMistake mistake;
  Plane plane;
};

// The planes that the host may have meant. A body that is high above its ground has a right normal.
std::array<OtherGround, 5> other_grounds(const Plane& given) {
  const Vec3 turned = given.normal * -1.0f;
  return {{{GroundMistake::offset_sign, {given.normal, -given.offset}},
           {GroundMistake::unit, {given.normal, 0.01f * given.offset}},
           {GroundMistake::unit, {given.normal, 100 * given.offset}},
           {GroundMistake::turned_normal, {turned, given.offset}},
           {GroundMistake::both_signs, {turned, -given.offset}}}};
}

// Finds the plane on which the body stands. If there are several, takes the nearest one. The body must be
// much nearer to it than to the given plane.
void find_mistake(const Instance& instance, bool is_above, GroundFinding& finding) {
  const Plane& given = instance.input.ground;
  const float radius = instance.input.bound.radius;
  float nearest = std::min((is_above ? 0.2f : 0.3f) * radius, 0.3f * std::abs(finding.depth));
  const std::size_t count = is_above ? 3 : 5;
  const auto others = other_grounds(given);
  for (std::size_t i = 0; i < count; ++i) {
    // In every unit, a floor near the origin has an offset near 0.
    if (others[i].mistake == GroundMistake::unit && std::abs(others[i].plane.offset) < 0.3f * radius)
      continue;
    const Depth depth = depth_below(instance, others[i].plane);
    if (depth.share_below > 0.2f || depth.lowest < -0.1f * radius || !(std::abs(depth.lowest) < nearest))
      continue;
    nearest = std::abs(depth.lowest);
    finding.mistake = others[i].mistake;
    finding.offset = others[i].plane.offset;
  }
}

}  // namespace

GroundFinding check_ground(const Instance& instance) noexcept {
  const Plane& given = instance.input.ground;
  // Some hosts hide a body by setting its matrices to zero. nearest_similarity gives such matrices the scale
  // 1e-6.
  const bool has_size = instance.input.largest_scale() > 2e-6f;
  if (!has_size || is_surely_above(instance, given)) return {};
  const Depth found = depth_below(instance, given);
  const float limit = has_bones(instance) ? deep_limit(instance.model->model).share : 0.05f;
  GroundFinding finding{found.share_deep > limit || found.share_below > 0.4f, false, found.share_below,
                        -found.lowest};
  finding.offset = given.offset;
  // A body that lies down is not as tall as it is long.
  const float size = std::max(found.highest - found.lowest,
                              instance.model->model.bounding_radius * instance.input.largest_scale());
  finding.floats = has_bones(instance) && found.lowest > size;
  if (finding.is_wrong || finding.floats) find_mistake(instance, !finding.is_wrong, finding);
  if (finding.floats) finding.is_wrong = finding.mistake != GroundMistake::height;
  return finding;
}

const Occluder* occluder_around(const Scene& scene, const Instance& instance) noexcept {
  const Sphere& body = instance.input.bound;
  if (instance.plan.is_far) return nullptr;  // its occluders are of an earlier update
  // The host hides a body with matrices of zeros.
  if (!(instance.input.largest_scale() > 2e-6f)) return nullptr;
  for (const std::uint32_t slot : instance.plan.occluders) {
    if (slot >= scene.occluders.size()) continue;  // of an earlier update
    const Occluder& occluder = scene.occluders[slot];
    if (occluder.id && length(occluder.sphere.centre - body.centre) + body.radius < occluder.sphere.radius)
      return &occluder;
  }
  return nullptr;
}

bool links_nobody(const Scene& scene) noexcept {
  if (scene.nearest == 0 || scene.living < 2) return false;
  return std::all_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
    // The radius of a body that the host hides with matrices of zeros tells nothing.
    return !instance.id || !(instance.input.largest_scale() > 2e-6f) ||
           scene.nearest_max_distance < 0.5f * instance.input.bound.radius;
  });
}

float relative_size(const Instance& instance) noexcept {
  const InstanceInput& input = instance.input;
  const float at_rest = instance.model->model.bounding_radius * input.largest_scale();
  return input.is_posed_on_gpu || !(at_rest > 0) ? 1 : input.bound.radius / at_rest;
}

const Instance* caster_at_same_place(const Scene& scene, const Instance& instance) noexcept {
  const Sphere& own = instance.input.bound;
  if (instance.plan.is_far) return nullptr;  // its casters come from an earlier update
  for (const std::uint32_t slot : instance.plan.casters) {
    if (slot >= scene.instances.size()) continue;  // the list comes from an earlier update
    const Instance& other = scene.instances[slot];
    if (other.id && &other != &instance && !other.plan.is_far && other.model.get() == instance.model.get() &&
        length(other.input.bound.centre - own.centre) < 0.01f * own.radius)
      return &other;
  }
  return nullptr;
}

}  // namespace nook
