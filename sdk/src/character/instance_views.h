// Passes the arrays of a scene's instances to the kernels.
#pragma once

#include <nook/experimental/nook_debug.h>
#include <algorithm>
#include <array>

#include "sdk/src/character/scene.h"

namespace nook {

// Returns the spheres of an instance at `level`, or at its coarsest level if the model has fewer levels.
inline SphereSoa spheres_of(const Instance& instance, std::uint32_t level) {
  const LoadedModel& model = *instance.model;
  const std::size_t l = std::min<std::size_t>(level, model.levels.size());
  const SphereLanes& s = l == 0 ? instance.arrays().spheres : instance.arrays().coarse_spheres[l - 1];
  const RestSpheres& rest = l == 0 ? model.rest_spheres : model.levels[l - 1].rest_spheres;
  return {s.x, s.y, s.z, s.inverse_radius, rest.caster_weight(), s.count};
}

// True if an update merges the spheres of far casters. The paper's form never merges them, because its norm
// is not a sum.
inline bool may_group(const Scene& scene) {
  return scene.settings.far_error > 0 && scene.settings.form == NOOK_FORM_DEFAULT;
}

// Returns the spheres of a caster for a receiver. Uses the coarsest tier of groups whose error is small
// enough at this distance, or else the spheres at the receiver's level. If a caster must not be grouped,
// group_spheres has not made groups for it.
inline SphereSoa caster_spheres(const Scene& scene, const Instance& receiver, const Instance& caster) {
  const InstanceResult& result = caster.result;
  if (result.grouped_revision == caster.input.pose_revision) {
    for (std::uint32_t t = group_tiers; t-- > 0;) {
      const GroupLanes& g = caster.arrays().groups[t];
      if (group_error(g, receiver.parts->receiver) < scene.settings.far_error)
        return {g.x, g.y, g.z, g.inverse_radius, g.caster_weight, g.count};
    }
  }
  return spheres_of(caster, receiver.plan.level);
}

// True if the instance's own spheres darken its key points. An instance that plays a clip uses baked AO
// instead.
inline bool has_self_shadow(const Scene& scene, const Instance& instance) {
  return (scene.terms & NOOK_TERM_SELF) && !instance.input.clip.is_used();
}

inline const RestKeyPoints& rest_points_of(const Instance& instance) {
  return instance.plan.level == 0 ? instance.model->rest_key_points
                                  : instance.model->levels[instance.plan.level - 1].rest_key_points;
}

// Returns the lanes of the key points that are evaluated at the instance's level.
inline PointLanes evaluated_points(const Instance& instance) {
  PointLanes points = instance.arrays().points;
  points.padded_count = rest_points_of(instance).padded_count();
  if (instance.plan.level > 0)
    points.count =
        static_cast<std::uint32_t>(instance.model->model.levels[instance.plan.level - 1].evaluated.size());
  return points;
}

inline KeyPointSoa fitted_points(const PointLanes& p) {
  return {p.x, p.y, p.z, p.nx, p.ny, p.nz, p.padded_count};
}
inline KeyPointSoa surface_points(const PointLanes& p) {
  return {p.surface_x, p.surface_y, p.surface_z, p.surface_nx, p.surface_ny, p.surface_nz, p.padded_count};
}

// Returns the number of spheres that darken the instance and do not belong to a character: the free
// occluders, and the ground if it is not skipped.
inline std::uint32_t free_sphere_count(const Instance& instance) {
  return static_cast<std::uint32_t>(instance.plan.occluders.size()) +
         (instance.plan.ground_sphere.radius > 0);
}

// Calls `apply` for the ground's sphere, unless the ground is skipped.
template <class Apply>
void for_ground(const Instance& instance, Apply&& apply) {
  const Sphere& ground = instance.plan.ground_sphere;
  if (!(ground.radius > 0)) return;
  const float inverse_radius = inverse_sphere_radius(ground.radius);
  apply(SphereSoa{&ground.centre.x, &ground.centre.y, &ground.centre.z, &inverse_radius, nullptr, 1});
}

// Calls `apply` for the free occluders, in batches that are stored on the stack. The caster weight of free
// occluders is 1.
template <class Apply>
void for_occluders(const Scene& scene, const Instance& instance, Apply&& apply) {
  constexpr std::uint32_t batch = 16;
  std::array<float, batch> x{}, y{}, z{}, inverse_radius{};
  std::uint32_t count = 0;
  const auto flush = [&] {
    if (count > 0) apply(SphereSoa{x.data(), y.data(), z.data(), inverse_radius.data(), nullptr, count});
    count = 0;
  };
  for (const std::uint32_t slot : instance.plan.occluders) {
    const Sphere& sphere = scene.occluders[slot].sphere;
    x[count] = sphere.centre.x;
    y[count] = sphere.centre.y;
    z[count] = sphere.centre.z;
    inverse_radius[count] = inverse_sphere_radius(sphere.radius);
    if (++count == batch) flush();
  }
  flush();
}

template <class Apply>
void for_free_spheres(const Scene& scene, const Instance& instance, Apply&& apply) {
  for_ground(instance, apply);
  for_occluders(scene, instance, apply);
}

}  // namespace nook
