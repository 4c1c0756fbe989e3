// Ways to look up a grid of probes near walls, as functions from a place to coefficients: those that the
// library has, and those of others that it is measured beside.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::lab {

using Lookup = std::function<void(Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients)>;

// The library's own: trilinear, or by the walls of the probes where they have some. offset: spacings along
// the normal, on top.
Lookup own_lookup(const probe::Probes& probes, float offset = 0);

// Trilinear weights of the corners that the place sees, by rays; of all of them where it sees none.
Lookup visibility_lookup(const probe::Probes& probes, const bake::LitScene& scene,
                         const std::vector<Vec3>& probe_positions_ws, float origin_offset);

// Moments of distance with Chebyshev's bound (Z. Majercik, J.-P. Guertin, D. Nowrouzezahrai, M. McGuire,
// Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, 2019, section 4): trilinear weights
// times the wrapped cosine to the probe, times the cubed bound, small weights crushed. The means over
// directions are those of the paper, the power 50 of the cosine, for exactly the direction from the probe to
// the place instead of a texel of an octahedral map, so that no resolution limits them.
class Moments {
 public:
  Moments(const bake::LitScene& scene, const std::vector<Vec3>& probe_positions_ws, Vec3 spacing_ws);
  Lookup lookup(const probe::Probes& probes) const;

 private:
  struct Ray {
    Vec3 direction;
    float distance;
  };
  float bound(std::size_t probe, Vec3 to_place, float distance) const;

  std::vector<Vec3> positions_ws_;
  std::vector<std::vector<Ray>> rays_;
  Vec3 spacing_ws_;
};

// The probes as ZH3 in half floats, as a shader reads them: their coefficients are the five zonal ones.
probe::Probes zonal_in_half_floats(const probe::Probes& probes);

}  // namespace nook::lab
