// Exact light of a whole map, summed over every texel: integrals weighted by solid angle, and irradiance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bakers/raytrace/environment.h"
#include "sdk/src/probe/basis.h"

namespace nook::bake::probe {

using nook::probe::Basis;
using nook::probe::Domain;

using Channels = std::array<double, 3>;  // RGB

// The part of the sphere whose light counts.
struct Region {
  Domain domain = Domain::sphere;
  Vec3 up{0, 1, 0};  // the hemisphere's axis

  bool holds(Vec3 direction) const { return domain == Domain::sphere || dot(up, direction) >= 0; }
};
inline Region region_of(const Basis& basis) {
  return {basis.domain, basis.up};
}

struct MapIntegrals {
  Channels radiance{};  // integral of the radiance f over the region
  Channels square{};    // integral of f^2
};
MapIntegrals integrate(const Environment& map, const Region& region);

// Returns the integrals of B_i f for all basis functions B_i. Subdivides texels until the sharpest function
// varies little within a part.
std::vector<Channels> moments(const Environment& map, const Basis& basis);

// Returns the irradiance on surfaces with these unit normals, from the light in the region. Each texel is
// treated as a point light at its centre.
std::vector<Vec3> map_irradiance(const Environment& map, const Region& region, std::span<const Vec3> normals);

// Returns the map at a lower resolution. Halves both sides while the map has more than most_columns columns
// and an even number of rows and columns.
Environment reduced(Environment map, std::uint32_t most_columns);

}  // namespace nook::bake::probe
