// C++17 wrappers of AO and light at points of the world: nook_world_sample.h.
#ifndef NOOK_WORLD_SAMPLE_HPP
#define NOOK_WORLD_SAMPLE_HPP

#include <cstdint>
#include <vector>

#include "../nook_character.hpp"
#include "nook_world_sample.h"

namespace nook {
inline namespace wrapper {

// Returns the capsules with which a model darkens the world. Throws UNSUPPORTED if the model was baked
// without capsules.
inline std::vector<nook_model_capsule> world_casters(const CharacterModel& model) {
  std::uint32_t count = NOOK_WORLD_MAX_CASTERS;
  std::vector<nook_model_capsule> casters(count);
  check(nook_model_read_capsules(model.get(), casters.data(), &count));
  casters.resize(count);
  return casters;
}

// You must set points and normals, and a light if you have one.
inline nook_world_sample_desc world_sample_desc() {
  nook_world_sample_desc desc;
  check(nook_world_sample_desc_init(&desc));
  return desc;
}

// Returns the AO at the points of `desc`.
inline std::vector<float> world_ao(const Scene& scene, const nook_world_sample_desc& desc) {
  std::vector<float> ao(desc.point_count);
  check(nook_world_sample(scene.get(), &desc, ao.data(), nullptr));
  return ao;
}

// Returns the open share of the light at the points of `desc`.
inline std::vector<float> world_light(const Scene& scene, const nook_world_sample_desc& desc) {
  std::vector<float> light(desc.point_count);
  check(nook_world_sample(scene.get(), &desc, nullptr, light.data()));
  return light;
}

}  // namespace wrapper
}  // namespace nook
#endif
