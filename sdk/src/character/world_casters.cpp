#include "sdk/src/character/world_casters.h"

#include <algorithm>
#include <cmath>

namespace nook {

float caster_strength(const PosedCaster& caster) {
  const Capsule& c = caster.capsule;
  const float radius = caster.ao_scale * std::max(c.radius_a, c.radius_b);
  constexpr float two_over_pi = 0.636619772f;
  return radius * (radius + two_over_pi * length(c.b - c.a));
}

void pose_world_casters(Instance& instance) noexcept {
  InstanceCasters& casters = instance.casters;
  if (casters.posed_revision == instance.input.pose_revision) return;
  casters.posed_revision = instance.input.pose_revision;
  casters.strength = 0;
  casters.bound = {};
  const auto& of_model = instance.model->model.world_casters;
  Vec3 sum;
  for (std::size_t i = 0; i < of_model.size(); ++i) {
    const WorldCaster& caster = of_model[i];
    const Mat3x4& bone = instance.input.bones[caster.bone];
    const float scale = length({bone.m[0], bone.m[4], bone.m[8]});
    PosedCaster& posed = casters.posed[i];
    posed.capsule = {transform_point(bone, caster.capsule.a), transform_point(bone, caster.capsule.b),
                     scale * caster.capsule.radius_a, scale * caster.capsule.radius_b};
    posed.ao_scale = caster.ao_scale;
    casters.strength += caster_strength(posed);
    sum += posed.capsule.a + posed.capsule.b;
  }
  if (of_model.empty()) return;
  casters.bound.centre = sum * (0.5f / static_cast<float>(of_model.size()));
  for (const PosedCaster& posed : casters.posed) {
    const Capsule& c = posed.capsule;
    const float wide = std::max(posed.ao_scale, 1.0f);
    casters.bound.radius =
        std::max({casters.bound.radius, length(c.a - casters.bound.centre) + wide * c.radius_a,
                  length(c.b - casters.bound.centre) + wide * c.radius_b});
  }
}

}  // namespace nook
