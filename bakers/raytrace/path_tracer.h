// Traces paths in diffuse scenes. The result is unbiased, and is the reference for all light probes.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bakers/raytrace/ambient_occlusion.h"
#include "bakers/raytrace/lit_scene.h"
#include "bakers/raytrace/random.h"

namespace nook::bake {

// Selects which part of the environment's light counts if it reaches the receiving point directly. Light that
// surfaces reflect always counts, including sunlight. Light that surfaces emit always counts too.
enum class DirectLight : std::uint8_t {
  none = 0,
  sky = 1,  // the environment without its suns, see environment.h
  all = 2
};

const std::vector<std::string>& direct_names();
DirectLight direct_of(const std::string& name);

struct PathSettings {
  std::uint32_t max_bounces = ~0u;  // maximum number of reflections; 0: direct light only
  float origin_offset = 1e-4f;      // metres along the normal, for rays that leave a surface
  DirectLight direct = DirectLight::all;
};

// Returns one estimate of the radiance that arrives at a point from a unit direction. settings.direct selects
// which part of the map's direct light is included.
Vec3 trace_radiance(const LitScene& scene, Vec3 origin, Vec3 direction, const PathSettings& settings,
                    Random& random);

struct IrradianceSettings {
  std::uint32_t rays = 64;  // per point
  std::uint64_t seed = 1;
  PathSettings path;
};

// Returns the RGB irradiance of every receiver, which is the integral of radiance times cosine over the
// hemisphere around the normal. The radii of receivers are not used. Threads work on blocks of receivers. The
// result does not depend on the number of threads. `progress` counts receivers. Throws
// Failure(NOOK_ERROR_CANCELLED) if `progress` returns false.
std::vector<Vec3> trace_irradiance(const LitScene& scene, const Receivers& receivers,
                                   const IrradianceSettings& settings, const Progress& progress = {});

}  // namespace nook::bake
