// Unbiased path tracing of diffuse scenes: the ground truth of everything that light probes claim.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/lit_scene.h"

namespace nook::bake {

struct PathSettings {
  std::uint32_t max_bounces = ~0u;  // reflections that count; 0: light that comes straight from its source
  float origin_offset = 1e-4f;      // metres along the normal, of rays that leave a surface
};

// A stream of numbers in [0, 1) that its key alone decides: paths do not depend on which thread traces them.
class PathRandom {
 public:
  explicit PathRandom(std::uint64_t key) : state_(mix_bits(key)) {}
  float next() { return unit_float(mix_bits(state_++)); }
  double next_double() { return double(mix_bits(state_++) >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

// One estimate of the radiance that arrives at a point from a unit direction.
Vec3 trace_radiance(const LitScene& scene, Vec3 origin, Vec3 direction, const PathSettings& settings,
                    PathRandom& random);

struct IrradianceSettings {
  std::uint32_t rays = 64;  // paths a point
  std::uint64_t seed = 1;
  PathSettings path;
};

// Irradiance (RGB, the integral of radiance times cosine over the hemisphere round the normal) of every
// receiver, whose radii are not used. Threads work on blocks of receivers, the result does not depend on
// their number. progress counts receivers; throws Failure(NOOK_ERROR_CANCELLED) when it returns false.
std::vector<Vec3> trace_irradiance(const LitScene& scene, const Receivers& receivers,
                                   const IrradianceSettings& settings, const Progress& progress = {});

}  // namespace nook::bake
