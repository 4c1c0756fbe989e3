// The light of an instance, and its occlusion in each channel.
#pragma once

#include <nook/nook_character.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/directional_occlusion.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/spherical_gaussian.h"

namespace nook {

struct Instance;
struct PointLanes;
struct Scene;

inline constexpr std::uint32_t max_light_lobes = NOOK_PROBE_MAX_FUNCTIONS;

inline constexpr std::size_t light_lanes = 15;  // of InstanceLight::storage

struct InstanceLight {
  AlignedArray<LightLobe> lobes;       // max_light_lobes, or none before the first light
  AlignedArray<LobeBands> lobe_bands;  // the same
  std::uint32_t count = 0;             // 0: no light
  Vec3 darkest;                        // see LightView
  LightBands bands;                    // of the lobes, without the parts that the ground hides
  bool evaluated = false;              // shadow and added belong to the current light

  // One array of PointLanes::padded_count for each channel; the pointers are into storage.
  float* shadow[3] = {};   // PointLanes::shadow
  float* added[3] = {};    // PointLanes::added
  float* sum[3] = {};      // scratch, of the evaluated key points
  float* open[3] = {};     // scratch, the same
  float* inverse[3] = {};  // scratch, the same
  AlignedArray<float> storage;

  LightView view() const { return {lobes.data(), count, darkest}; }
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) unless there are at most max_light_lobes and each is a lobe.
void check_light_lobes(std::span<const SphericalGaussian> lobes);

// Without lobes the instance loses its light. On a bad id or lobe it throws Failure, without memory
// std::bad_alloc, and changes nothing. Allocates only at the first light of an instance.
void set_light(Scene& scene, nook_instance_id id, std::span<const SphericalGaussian> lobes);

// Returns the light of an instance after a change of its model: the same lobes, not evaluated yet. Throws
// std::bad_alloc.
InstanceLight moved_light(const InstanceLight& light, const PointLanes& points, Memory* memory);

// Runs after resolve_casters: computes the part of each lobe that the ground leaves, and its bands. Does
// nothing without a light.
void prepare_light(const Scene& scene, Instance& instance) noexcept;

// Runs after evaluate_shadows: computes the colours of shadow and added occlusion. Does nothing without a
// light.
void evaluate_directional(const Scene& scene, Instance& instance) noexcept;

}  // namespace nook
