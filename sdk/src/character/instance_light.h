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
struct LoadedModel;
struct Scene;

inline constexpr std::uint32_t max_light_lobes = NOOK_PROBE_MAX_FUNCTIONS;

inline constexpr std::size_t light_lanes = 15;  // number of arrays in InstanceLight::storage

struct InstanceLight {
  AlignedArray<LightLobe> lobes;       // max_light_lobes elements, or empty before the first light
  AlignedArray<LobeBands> lobe_bands;  // one element for each element of `lobes`
  std::uint32_t count = 0;             // 0: no light
  Vec3 darkest;                        // see LightView
  LightBands bands;                    // bands of the lobes, without the parts that the ground hides
  bool evaluated = false;              // true if `shadow` and `added` were computed for the current light

  // One array of PointLanes::padded_count for each channel; the pointers are into storage.
  float* shadow[3] = {};   // the coloured form of PointLanes::shadow
  float* added[3] = {};    // the coloured form of PointLanes::added
  float* sum[3] = {};      // scratch memory for the evaluated key points
  float* open[3] = {};     // scratch memory, like `sum`
  float* inverse[3] = {};  // scratch memory, like `sum`
  AlignedArray<float> storage;

  LightView view() const { return {lobes.data(), count, darkest}; }
};

// Throws Failure(NOOK_ERROR_INVALID_ARGUMENT) if there are more than max_light_lobes, or if one of them is
// not a valid lobe.
void check_light_lobes(std::span<const SphericalGaussian> lobes);

// Sets the light of an instance, or removes it if `lobes` is empty. Throws Failure for an invalid id or lobe,
// and std::bad_alloc if memory runs out. After an exception, the scene is unchanged. Allocates memory only
// for the first light of an instance.
void set_light(Scene& scene, nook_instance_id id, std::span<const SphericalGaussian> lobes);

// Returns an instance's light with arrays for another model. The new light has the same lobes, but is not
// evaluated yet. Throws std::bad_alloc.
InstanceLight moved_light(const Scene& scene, const InstanceLight& light, const LoadedModel& model);

// make_arrays and leave_arrays (scene.h) call these for the arrays of the light.
void make_light_arrays(const Scene& scene, Instance& instance);
void leave_light_arrays(Instance& instance) noexcept;

// Call it after resolve_casters. Computes the fraction of each lobe that the ground does not hide, and the
// bands of the remaining light. Does nothing without a light.
void prepare_light(const Scene& scene, Instance& instance) noexcept;

// Call it after evaluate_shadows. Computes the shadow and the added occlusion for each colour channel. Does
// nothing without a light.
void evaluate_directional(const Scene& scene, Instance& instance) noexcept;

}  // namespace nook
