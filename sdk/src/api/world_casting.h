// Collects the casters for one call: the bodies and occluders of a scene, and the capsules that the host
// passes, which are called props.
#pragma once

#include <nook/nook_world.h>

#include "sdk/src/character/scene.h"
#include "sdk/src/world/caster_parts.h"
#include "sdk/src/world/light_terms.h"
#include "sdk/src/world/sample.h"

namespace nook::api {

inline Vec3 vector_of(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

// Throws Failure unless every prop is a valid capsule. The message begins with `descriptor`, the descriptor's
// name.
void check_props(const char* descriptor, const nook_capsule* props, std::uint32_t count);

// Converts lobes to light terms. If `turn` is not NULL, the axes of the lobes are rotated by this matrix,
// which is column-major and has four floats per column. Without lobes, the light is constant. Throws Failure
// unless every lobe is valid. The message begins with the descriptor's name.
world::LightTerms terms_of_lobes(const char* descriptor, const nook_lobe* lobes, std::uint32_t count,
                                 const float* turn = nullptr);

// Checks a cone of light and returns its axis with unit length. Throws Failure if the axis or the angle is
// invalid.
Vec3 checked_light(const char* descriptor, const float (&axis)[3], float degrees);

inline float half_angle_radians(float degrees) {
  return 0.5f * degrees * 0.0174532925f;
}

class Casting {
 public:
  // Poses the casters of the scene's instances. Instances with poses on the GPU and far instances of a pool
  // do not cast. `scene` may be NULL. `receiver` is an instance that must not cast, or 0.
  Casting(Scene* scene, nook_instance_id receiver, const nook_capsule* props, std::uint32_t prop_count);

  // Returns the number of groups. The groups are the bodies by slot, then the occluders by slot, then the
  // props. A free slot is a group without casters.
  std::uint32_t group_count() const;
  // If a group is a body, returns its parts. Otherwise returns NULL. The result is valid until the next call.
  const world::CasterParts* parts(std::uint32_t index) const;
  // A callback for world::CasterGroups; `user` must point to a Casting. Occluders and props have infinite
  // strength, so they are never skipped.
  static world::CasterGroup group(const void* user, std::uint32_t index, PosedCaster& room);

 private:
  // Checks is_far too, because a far instance of a pool also has parts if the host posed it on the CPU.
  static bool can_cast(const Instance& instance) {
    return instance.parts && !instance.plan.is_far && !instance.input.is_posed_on_gpu;
  }
  bool casts(const Instance& instance) const { return can_cast(instance) && instance.id != receiver_; }
  bool casts(const Occluder& occluder) const {
    return occluder.id != 0 && (occluder.receiver == 0 || occluder.receiver == receiver_);
  }

  const Scene* scene_;
  nook_instance_id receiver_;
  const nook_capsule* props_;
  std::uint32_t prop_count_;
  // The model for which the cached parts were made. Caching one model is enough, because most bodies of a
  // crowd have the same model.
  mutable const CharacterModel* parts_of_ = nullptr;
  mutable world::CasterParts parts_;
};

}  // namespace nook::api
