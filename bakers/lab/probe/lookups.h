// Ways to look up a grid of probes near walls: Nook's, and those that other engines use. Each way is a
// function that maps a place to coefficients.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "bakers/raytrace/lit_scene.h"
#include "sdk/src/probe/probe.h"

namespace nook::lab {

using Lookup = std::function<void(Vec3 position_ws, Vec3 normal, std::span<Vec3> coefficients)>;

// Returns the library's own lookup. It is trilinear, or uses the walls of the probes if they have walls.
// `offset` moves the place along the normal, in units of the grid spacing.
Lookup own_lookup(const probe::Probes& probes, float offset = 0);

// Returns a trilinear lookup that uses only those probes at the corners of the cell that are visible from the
// place. Rays test the visibility. If no corner is visible, the lookup uses all corners.
Lookup visibility_lookup(const probe::Probes& probes, const bake::LitScene& scene,
                         const std::vector<Vec3>& probe_positions_ws, float origin_offset);

// Lookup with moments of distance and Chebyshev's bound (Z. Majercik, J.-P. Guertin, D. Nowrouzezahrai, M.
// McGuire, Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields, 2019, section 4). It
// multiplies trilinear weights by the wrapped cosine towards the probe and by the cube of the bound. Small
// weights are reduced further. As in the paper, the moments are averaged over directions, weighted by the
// 50th power of the cosine. Unlike the paper, they are evaluated in the exact direction from the probe to the
// place, and not at a texel of an octahedral map. Their accuracy is therefore not limited by a resolution.
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

// Returns the probes as ZH3 in half floats, as a shader reads them. Each probe has the five zonal
// coefficients.
probe::Probes zonal_in_half_floats(const probe::Probes& probes);

}  // namespace nook::lab
