// The light of self-shadow: bands 0 to 2 of the lobes. The fitted spheres darken from all sides, so that
// their shadow has little directional detail. With bands the sum over spheres is independent of the lobes:
// the mean of the light under a density exp(dot(b, s)) is
//   scalar + A1 dot(vector, d) + A2 dot(d, tensor d),  d = b / |b|,
// where A1 = 1 - 1 / |b| and A2 = 1 - 3 A1 / |b| are the bands of the density without e^(-2 |b|), which is
// below 0.015 here. So a key point sums the weighted densities of its spheres and combines them with the
// light once.
//
// All functions are templates over a number type F, as in kernel.h.
#pragma once

#include "sdk/src/character/directional.h"

namespace nook {

// The components x, y, z are the channels red, green, blue.
struct LightBands {
  Vec3 scalar;     // mean radiance of all directions
  Vec3 vector[3];  // x, y, z
  Vec3 tensor[6];  // xx, yy, zz, and twice xy, yz, zx; its trace is 0
  Vec3 darkest;    // see LightView
};

// The bands of a lobe; they do not depend on its amplitude.
struct LobeBands {
  float scalar = 0, vector = 0, tensor = 0;
};

// Of the self-shadow this share follows the light, the rest is shadow of all of it; k as caster_concentration
// has it. Both measured against rays in a crowd.
inline constexpr float self_strength = float(NOOK_SELF_STRENGTH);
inline constexpr float self_concentration = float(NOOK_SELF_CONCENTRATION);

template <class F>
struct GatheredBands {
  F scalar, x, y, z, xx, yy, zz, xy, yz, zx;

  static GatheredBands none() {
    const F o(0.0f);
    return {o, o, o, o, o, o, o, o, o, o};
  }
  // Adds the density of vector b, with |b| >= directional_cosine unless the blend of bones cancels the
  // normal.
  void add(const Direction<F>& b, F weight) {
    const F t = rsqrt(max(fma(b.x, b.x, fma(b.y, b.y, b.z * b.z)), F(1.0f)));
    const F a1 = F(1.0f) - t, a2 = fma(F(-3.0f) * t, a1, F(1.0f));
    const Direction<F> d{b.x * t, b.y * t, b.z * t};
    const F first = weight * a1, second = weight * a2;
    scalar = scalar + weight;
    x = fma(first, d.x, x);
    y = fma(first, d.y, y);
    z = fma(first, d.z, z);
    const F sx = second * d.x, sy = second * d.y, sz = second * d.z;
    xx = fma(sx, d.x, xx);
    yy = fma(sy, d.y, yy);
    zz = fma(sz, d.z, zz);
    xy = fma(sx, d.y, xy);
    yz = fma(sy, d.z, yz);
    zx = fma(sz, d.x, zx);
  }
  // Returns one channel of the light under the summed densities, times the sum of weights.
  F light(const LightBands& bands, float Vec3::*channel) const {
    const auto c = [&](const Vec3& v) { return F(v.*channel); };
    const F one = fma(x, c(bands.vector[0]), fma(y, c(bands.vector[1]), z * c(bands.vector[2])));
    const F straight = fma(xx, c(bands.tensor[0]), fma(yy, c(bands.tensor[1]), zz * c(bands.tensor[2])));
    const F mixed = fma(xy, c(bands.tensor[3]), fma(yz, c(bands.tensor[4]), zx * c(bands.tensor[5])));
    return fma(scalar, c(bands.scalar), one) + (straight + mixed);
  }
};

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

}  // namespace nook
