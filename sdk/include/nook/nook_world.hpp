// C++17 wrappers of world casters: nook_world.h.
#ifndef NOOK_WORLD_HPP
#define NOOK_WORLD_HPP

#include <cstdint>
#include <vector>

#include "nook_character.hpp"
#include "nook_world.h"

namespace nook {
inline namespace wrapper {

// The casters of a model; throws UNSUPPORTED for a model that was baked without.
inline std::vector<nook_world_caster> world_casters(const CharacterModel& model) {
  std::uint32_t count = NOOK_WORLD_MAX_CASTERS;
  std::vector<nook_world_caster> casters(count);
  check(nook_world_read_casters(model.get(), casters.data(), &count));
  casters.resize(count);
  return casters;
}

// The caller sets points and normals, and a light where there is one.
inline nook_world_sample_desc world_sample_desc() {
  nook_world_sample_desc desc;
  check(nook_world_sample_desc_init(&desc, sizeof desc, NOOK_VERSION));
  return desc;
}

// The AO at the points of desc.
inline std::vector<float> world_ao(const Scene& scene, const nook_world_sample_desc& desc) {
  std::vector<float> ao(desc.point_count);
  check(nook_world_sample(scene.get(), &desc, ao.data(), nullptr));
  return ao;
}

// The open share of the light of desc at its points.
inline std::vector<float> world_light(const Scene& scene, const nook_world_sample_desc& desc) {
  std::vector<float> light(desc.point_count);
  check(nook_world_sample(scene.get(), &desc, nullptr, light.data()));
  return light;
}

}  // namespace wrapper
}  // namespace nook
#endif
