// Ray-traced ambient occlusion of the crowd, and how far Nook's is from it.
#pragma once

#include <span>
#include <vector>

#include "samples/crowd/hero.h"

namespace crowd {

struct TraceRequest {
  std::uint32_t rays = 64;  // a vertex
  std::uint64_t seed = 1;
  bool ground = true;
};

// AO of the receivers' vertices, one array for each, against all bodies near them and, if asked for, the
// ground plane y = 0.
std::vector<std::vector<float>> traced_ao(const Hero& hero, const std::vector<Bones>& poses,
                                          std::span<const std::uint32_t> receivers,
                                          const TraceRequest& request);

// A square of the ground plane y = 0 with side x side points; the first lies at the low corner, x runs
// fastest.
struct FloorPatch {
  float low_x_m = 0, low_z_m = 0, size_m = 1;
  std::uint32_t side = 2;
};

// AO of the patch against the given bodies alone, with rays of radius_m.
std::vector<float> traced_floor_ao(const Hero& hero, const std::vector<Bones>& poses,
                                   std::span<const std::uint32_t> casters, const FloorPatch& patch,
                                   float radius_m, const TraceRequest& request);

// Irradiance of the receivers' vertices and of a patch of the floor, three floats each, from the environment
// past all bodies near them and the ground, all of them black: what occlusion alone leaves of the light.
struct TracedLight {
  std::vector<std::vector<float>> bodies;
  std::vector<float> floor;
};
TracedLight traced_light(const Hero& hero, const std::vector<Bones>& poses,
                         std::span<const std::uint32_t> receivers, const FloorPatch* patch,
                         const nook_bake_environment& environment, const TraceRequest& request);

struct Errors {
  double mse = 0;       // mean over vertices
  double mse_area = 0;  // weighted by the area of the posed surface
};

// Over all receivers; vertices that no triangle uses, copies at seams, are left out.
// `channels` values a vertex, errors in units of `unit`.
Errors compare(const Hero& hero, const std::vector<Bones>& poses, std::span<const std::uint32_t> receivers,
               const std::vector<std::vector<float>>& values, const std::vector<std::vector<float>>& truth,
               std::uint32_t channels = 1, float unit = 1);

}  // namespace crowd
