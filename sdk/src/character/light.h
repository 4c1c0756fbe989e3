// The light of an instance, and its occlusion by channel: which part of the light the spheres take.
#pragma once

#include <nook/nook_character.h>

#include <cstdint>
#include <span>

#include "sdk/src/character/directional.h"
#include "sdk/src/character/directional_bands.h"
#include "sdk/src/core/aligned_array.h"
#include "sdk/src/core/spherical_gaussian.h"

namespace nook {

struct Instance;
struct Scene;

inline constexpr std::uint32_t max_light_lobes = NOOK_PROBE_MAX_FUNCTIONS;

struct InstanceLight {
  AlignedArray<LightLobe> lobes;       // max_light_lobes, or none before the first light
  AlignedArray<LobeBands> lobe_bands;  // the same
  std::uint32_t count = 0;             // 0: no light
  Vec3 darkest;                        // of LightView
  LightBands bands;                    // of the lobes as the ground leaves them
  bool evaluated = false;              // shadow and added are of a light, not of the one before none

  // By channel, PointLanes::padded_count long; pointers into storage.
  float* shadow[3] = {};   // PointLanes::shadow
  float* added[3] = {};    // PointLanes::added
  float* sum[3] = {};      // scratch, of the evaluated key points
  float* open[3] = {};     // scratch, the same
  float* inverse[3] = {};  // scratch, the same
  AlignedArray<float> storage;

  LightView view() const { return {lobes.data(), count, darkest}; }
};

// No lobes: the instance has no light again. Throws Failure on a bad id or lobe, and std::bad_alloc, and then
// changes nothing; allocates at the first light of an instance only.
void set_light(Scene& scene, nook_instance_id id, std::span<const SphericalGaussian> lobes);

// After resolve_casters: what the ground leaves of each lobe, and the bands of that. Nothing without a light.
void prepare_light(const Scene& scene, Instance& instance) noexcept;

// After evaluate_shadows: the colours of its shadow and added occlusion. Nothing without a light.
void evaluate_directional(const Scene& scene, Instance& instance) noexcept;

// As read_ao, three floats a vertex; AO in all of them where the last update saw no light.
void read_directional_ao(const Scene& scene, const Instance& instance, float* out,
                         std::size_t stride_bytes) noexcept;

}  // namespace nook
