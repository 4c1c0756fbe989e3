#include "sdk/src/character/body_check.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/core/affine.h"

namespace nook {
namespace {

struct Depth {
  float share_below = 0, share_deep = 0;
  float lowest = INFINITY;  // signed distance of the lowest point from the plane, in metres
};

// Only the bound of such a pose is known, because the bones on the CPU still have an earlier pose. A standing
// body reaches about 0.85 of the radius of its bound downwards.
Depth depth_of_bound(const Sphere& bound, const Plane& plane) {
  const float middle = dot(plane.normal, bound.centre) - plane.offset, half = 0.85f * bound.radius;
  return {std::clamp(0.5f - 0.5f * middle / std::max(half, 1e-9f), 0.0f, 1.0f), middle < 0 ? 1.0f : 0.0f,
          middle - half};
}

Depth depth_below(const Instance& instance, const Plane& plane) {
  const InstanceInput& input = instance.input;
  if (input.is_posed_on_gpu || input.clip.is_late || !instance.parts || instance.parts->bones.empty())
    return depth_of_bound(input.bound, plane);
  const CharacterModel& model = instance.model->model;
  const float deep = -0.3f * model.bounding_radius * input.largest_scale();
  const float share = 1 / float(std::max<std::size_t>(model.spheres.size(), 1));
  Depth depth;
  for (const ProxySphere& sphere : model.spheres) {
    const Vec3 centre = transform_point(instance.parts->bones[sphere.bone], sphere.centre);
    const float distance = dot(plane.normal, centre) - plane.offset;
    depth.share_below += distance < 0 ? share : 0;
    depth.share_deep += distance < deep ? share : 0;
    depth.lowest = std::min(depth.lowest, distance);
  }
  return depth;
}

}  // namespace

GroundFinding check_ground(const Instance& instance) noexcept {
  const Plane& given = instance.input.ground;
  const Depth found = depth_below(instance, given);
  GroundFinding finding{found.share_deep > 0.05f || found.share_below > 0.4f, found.share_below,
                        -found.lowest};
  if (!finding.is_wrong) return finding;
  const Vec3 turned = given.normal * -1.0f;
  const struct {
    GroundMistake mistake;
    Plane plane;
  } others[] = {{GroundMistake::turned_normal, {turned, given.offset}},
                {GroundMistake::both_signs, {turned, -given.offset}},
                {GroundMistake::offset_sign, {given.normal, -given.offset}}};
  // The host most likely meant a plane on which the body stands, the nearest one if there are several.
  const float radius = instance.input.bound.radius;
  float nearest = 0.3f * radius;
  for (const auto& other : others) {
    const Depth depth = depth_below(instance, other.plane);
    if (depth.share_below > 0.2f || depth.lowest < -0.1f * radius || !(std::abs(depth.lowest) < nearest))
      continue;
    nearest = std::abs(depth.lowest);
    finding.mistake = other.mistake;
  }
  return finding;
}

float relative_size(const Instance& instance) noexcept {
  const InstanceInput& input = instance.input;
  const float at_rest = instance.model->model.bounding_radius * input.largest_scale();
  return input.is_posed_on_gpu || !(at_rest > 0) ? 1 : input.bound.radius / at_rest;
}

const Instance* caster_at_same_place(const Scene& scene, const Instance& instance) noexcept {
  const Sphere& own = instance.input.bound;
  for (const std::uint32_t slot : instance.plan.casters) {
    if (slot >= scene.instances.size()) continue;  // of an earlier update
    const Instance& other = scene.instances[slot];
    if (other.id && &other != &instance && other.model.get() == instance.model.get() &&
        length(other.input.bound.centre - own.centre) < 0.01f * own.radius)
      return &other;
  }
  return nullptr;
}

}  // namespace nook
