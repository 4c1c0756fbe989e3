// Looks up a grid of probes near walls, in Nook's ways and in the ways of other engines. A way is a function
// from a place to coefficients.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::lab {

using Lookup = std::function<void(Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients)>;

// The library's own lookup: trilinear, or by the walls of the probes if they have some. offset: further
// spacings along the normal.
Lookup own_lookup(const probe::Probes& probes, float offset = 0);

// Trilinear weights of the corners that the place sees, by rays; of all corners if it sees none.
Lookup visibility_lookup(const probe::Probes& probes, const bake::LitScene& scene,
                         const std::vector<Vec3>& probe_positions_ws, float origin_offset);

// Moments of distance with Chebyshev's bound (Z. Majercik, J.-P. Guertin, D. Nowrouzezahrai, M. McGuire,
// Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, 2019, section 4). It multiplies
// trilinear weights by the wrapped cosine to the probe and by the cubed bound, and crushes small weights.
// Like the paper, it takes means over directions by the power 50 of the cosine. It evaluates them in the
// exact direction from the probe to the place, not at a texel of an octahedral map, so that no resolution
// limits them.
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

// Returns the probes as ZH3 in half floats, as a shader reads them: their coefficients are the five zonal
// ones.
probe::Probes zonal_in_half_floats(const probe::Probes& probes);

}  // namespace nook::lab
