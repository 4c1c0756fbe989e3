#include "sdk/src/api/world_casting.h"

#include <algorithm>
#include <cmath>

#include "sdk/src/character/instance_light.h"
#include "sdk/src/character/scene.h"
#include "sdk/src/core/failure.h"
#include "sdk/src/core/geometry.h"

namespace nook::api {
namespace {

PosedCaster caster_of(const nook_capsule& prop) {
  return {{vector_of(prop.a), vector_of(prop.b), prop.radius_a, prop.radius_b}, 1};
}

world::CasterGroup lone(const PosedCaster& caster, PosedCaster& room) {
  room = caster;
  const Capsule& c = room.capsule;
  return {
      {&room, 1}, 0.5f * (c.a + c.b), 0.5f * length(c.b - c.a) + std::max(c.radius_a, c.radius_b), INFINITY};
}

template <class Objects>
std::uint32_t size_of(const Objects& objects) {
  return static_cast<std::uint32_t>(objects.size());
}

}  // namespace

void check_props(const char* descriptor, const nook_capsule* props, std::uint32_t count) {
  if (count > 0 && !props)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.capsules is NULL, but %s.capsule_count is %u", descriptor,
                  descriptor, count);
  constexpr std::uint32_t largest = 1u << 20;
  if (count > largest)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.capsule_count is too large (got %u, need at most %u)",
                  descriptor, count, largest);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const auto& end : {props[i].a, props[i].b})
      if (!is_place({end[0], end[1], end[2]}))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "%s.capsules[%u] has an end out of range (got %g %g %g, need finite metres below 1e6)",
                      descriptor, i, double(end[0]), double(end[1]), double(end[2]));
    for (const float radius : {props[i].radius_a, props[i].radius_b})
      if (!(radius > 0 && radius <= max_metres))
        throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                      "%s.capsules[%u] has a radius out of range (got %g, need metres above 0)", descriptor,
                      i, double(radius));
  }
}

Vec3 checked_light(const char* descriptor, const float (&axis)[3], float degrees) {
  if (!(degrees > 0 && degrees < 179))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s.light_degrees is out of range (got %g, need 0, or more than 0 and less than 179)",
                  descriptor, double(degrees));
  const Vec3 towards = vector_of(axis);
  if (!(std::abs(length(towards) - 1) <= 1e-3f))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "%s.light_axis is not of unit length (got %g, need 1 within 0.001)", descriptor,
                  double(length(towards)));
  return normalised(towards);
}

world::LightTerms terms_of_lobes(const char* descriptor, const nook_lobe* lobes, std::uint32_t count,
                                 const float* turn) {
  if (count > 0 && !lobes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.lobes is NULL, but %s.lobe_count is %u", descriptor,
                  descriptor, count);
  if (count > max_light_lobes)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "%s.lobe_count is too large (got %u, need at most %u)",
                  descriptor, count, max_light_lobes);
  if (count == 0) {
    world::LightTerms constant;
    constant.term[0] = constant.darkest = {1, 1, 1};
    return constant;
  }
  std::array<SphericalGaussian, max_light_lobes> light;
  for (std::uint32_t i = 0; i < count; ++i)
    light[i] = {vector_of(lobes[i].axis), lobes[i].sharpness, vector_of(lobes[i].amplitude)};
  const std::span<SphericalGaussian> all{light.data(), count};
  check_light_lobes(all);
  for (SphericalGaussian& lobe : all)
    if (const Vec3 axis = lobe.axis; turn)
      lobe.axis = axis.x * Vec3{turn[0], turn[1], turn[2]} + axis.y * Vec3{turn[4], turn[5], turn[6]} +
                  axis.z * Vec3{turn[8], turn[9], turn[10]};
  return world::terms_of(all);
}

Casting::Casting(Scene* scene, nook_instance_id receiver, const nook_capsule* props, std::uint32_t prop_count)
    : scene_(scene), receiver_(receiver), props_(props), prop_count_(prop_count) {
  if (!scene) return;
  for (Instance& instance : scene->instances)
    if (can_cast(instance)) pose_world_casters(instance);
}

std::uint32_t Casting::group_count() const {
  return (scene_ ? size_of(scene_->instances) + size_of(scene_->occluders) : 0) + prop_count_;
}

const world::CasterParts* Casting::parts(std::uint32_t index) const {
  if (!scene_ || index >= scene_->instances.size()) return nullptr;
  const CharacterModel& model = scene_->instances[index].model->model;
  if (parts_of_ != &model) {
    std::array<Vec3, world::max_part_casters> middle;
    for (std::size_t i = 0; i < model.world_casters.size(); ++i)
      middle[i] = 0.5f * (model.world_casters[i].capsule.a + model.world_casters[i].capsule.b);
    parts_ = world::parts_of({middle.data(), model.world_casters.size()});
    parts_of_ = &model;
  }
  return &parts_;
}

world::CasterGroup Casting::group(const void* user, std::uint32_t index, PosedCaster& room) {
  const Casting& casting = *static_cast<const Casting*>(user);
  if (const Scene* const scene = casting.scene_) {
    if (index < scene->instances.size()) {
      const Instance& instance = scene->instances[index];
      if (!casting.casts(instance)) return {};
      const InstanceCasters& casters = instance.casters();
      return {{casters.posed.data(), casters.posed.size()},
              casters.bound.centre,
              casters.bound.radius,
              casters.strength};
    }
    index -= size_of(scene->instances);
    if (index < scene->occluders.size()) {
      const Occluder& occluder = scene->occluders[index];
      if (!casting.casts(occluder)) return {};
      return lone(nook::caster_of(occluder.sphere), room);
    }
    index -= size_of(scene->occluders);
  }
  return lone(caster_of(casting.props_[index]), room);
}

}  // namespace nook::api
