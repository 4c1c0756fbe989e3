// The light of self-shadow: bands 0 to 2 of the lobes (core/light_bands.h). The fitted spheres darken from
// all sides, so that their shadow has little directional detail. A key point sums the weighted densities of
// its spheres and combines them with the light once.
//
// All functions are templates over a number type F, as in kernel.h.
#pragma once

#include "sdk/src/character/directional.h"
#include "sdk/src/core/light_bands.h"

namespace nook {

// Of the self-shadow this share follows the light, the rest is shadow of all of it; k as caster_concentration
// has it. Both measured against rays in a crowd.
inline constexpr float self_strength = float(NOOK_SELF_STRENGTH);
inline constexpr float self_concentration = float(NOOK_SELF_CONCENTRATION);

// Returns the density of a sphere of the body itself that takes y^gamma = `term` of the light.
template <class F>
void gather(GatheredBands<F>& gathered, const Direction<F>& n, const Sight<F>& sight, F y, F term) {
  const F k = concentration_of(sight, max(y, F(smallest_share)), self_concentration), h(directional_cosine);
  const Direction<F>& d = sight.towards;
  gathered.add(Direction<F>{fma(d.x, k, n.x * h), fma(d.y, k, n.y * h), fma(d.z, k, n.z * h)}, term);
}

// Sums the terms, each times the light that it takes.
template <class F>
Colour<F> coloured_sum(const GatheredBands<F>& gathered, const LightBands& bands, const Direction<F>& n) {
  GatheredBands<F> open = GatheredBands<F>::none();
  const F h(directional_cosine), one(1.0f);
  open.add(Direction<F>{n.x * h, n.y * h, n.z * h}, one);
  const auto channel = [&](float Vec3::*c) {
    const F ratio = gathered.light(bands, c) / max(open.light(bands, c), F(bands.darkest.*c));
    const F bounded = min(max(ratio, F(0.0f)), F(largest_ratio) * gathered.scalar);
    return fma(F(self_strength), bounded, F(1 - self_strength) * gathered.scalar);
  };
  return {channel(&Vec3::x), channel(&Vec3::y), channel(&Vec3::z)};
}

// Returns the light that a vertex' self-shadow takes, relative to its share of all directions: sums over its
// key points, of the coloured shadow and of the shadow. Without shadow it is 1.
template <class F>
F vertex_light_ratio(F coloured, F shadow) {
  return (coloured + F(smallest_share)) / (max(shadow, F(0.0f)) + F(smallest_share));
}

}  // namespace nook
